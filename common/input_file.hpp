// Input files: reads their bytes, recognises a file of the wrong kind, and normalises text. Every reader in
// the project opens its file here.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace fc {

// The whole content of a file.
struct InputFile {
  std::filesystem::path path;
  std::string bytes;

  // Refuses the file as a whole: "path: message".
  [[noreturn]] void fail(const std::string& message) const;
};

// Reads a file. Refuses one that is missing, a folder, cannot be read, or has more than `largest` bytes.
// `wanted` is what should be in it, for the message: "a mesh".
InputFile read_input_file(const std::filesystem::path& path, const char* wanted,
                          std::size_t largest = std::numeric_limits<std::size_t>::max());

// What a file is, judged by its first bytes.
struct FileKind {
  const char* name;       // "gzip data", "a PLY mesh"
  const char* advice;     // what to do where something else is wanted
  const char* extension;  // of the mesh formats that we read, else ""
};

// Recognises packed files, UTF-16, web pages, pictures, the common model formats, and those that are read
// here. Empty if it is none of these; what it is then remains open.
std::optional<FileKind> file_kind(std::string_view bytes);

// Refuses content that file_kind recognises, unless it is the format with the reader's own extension: "path:
// is gzip data, not an OBJ mesh; unpack it first".
void refuse_other_kind(const InputFile& file, const char* wanted, std::string_view own_extension = "");

// Normalises a text: removes the byte order mark, and turns each line end (\n, \r\n or \r) into \n. Lines and
// columns counted in the result are those that an editor shows.
void unify_text(std::string& text);

// unify_text for a file that must be text: refuses a zero byte, and names its place. `first_line` is the
// number of the line that the bytes begin with.
void make_text(InputFile& file, const char* wanted, int first_line = 1);

}  // namespace fc

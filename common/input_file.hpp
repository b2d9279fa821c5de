// Files that people give us: their bytes, what they are if they are not what was asked for, and their text in
// one form. Every reader of ours opens its file here.
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

// What a content is by its first bytes.
struct FileKind {
  const char* name;       // "gzip data", "a PLY mesh"
  const char* advice;     // what to do where something else is wanted
  const char* extension;  // of the mesh formats that we read, else ""
};

// Knows packed files, UTF-16, web pages, pictures, the common formats of models, and those that we read
// ourselves. Nothing: none of these, which says nothing about what it is.
std::optional<FileKind> file_kind(std::string_view bytes);

// Refuses a content that file_kind knows, unless it is the format with the reader's own extension:
// "path: is gzip data, not an OBJ mesh; unpack it first".
void refuse_other_kind(const InputFile& file, const char* wanted, std::string_view own_extension = "");

// Makes one form of the forms of a text: without a byte order mark, and with \n for each line end, be it \n,
// \r\n or \r. Lines and columns counted in the result are those that an editor shows.
void unify_text(std::string& text);

// unify_text for a file that must be a text: refuses a zero byte, with its place. `first_line` is the number
// of the line that the bytes begin with.
void make_text(InputFile& file, const char* wanted, int first_line = 1);

}  // namespace fc

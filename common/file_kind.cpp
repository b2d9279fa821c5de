// Recognises what a file is by its first bytes, so that a message can name it.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

#include "common/byte_order.hpp"
#include "common/input_file.hpp"

namespace fc {
namespace {

constexpr const char* kUnpack = "unpack it first";
constexpr const char* kExport = "export a mesh as .obj, .stl or .ply";
constexpr const char* kCheck = "check the file's name and content";
constexpr const char* kDownload = "fetch the file itself";
constexpr const char* kEncode = "save it as UTF-8";

struct Beginning {
  std::string_view bytes;
  FileKind kind;
};

using namespace std::string_view_literals;

constexpr std::array kBeginnings = {
    Beginning{"\x1f\x8b"sv, {"gzip data", kUnpack, ""}},
    Beginning{"BZh"sv, {"bzip2 data", kUnpack, ""}},
    Beginning{"\xfd\x37zXZ"sv, {"xz data", kUnpack, ""}},
    Beginning{"\x28\xb5\x2f\xfd"sv, {"zstd data", kUnpack, ""}},
    Beginning{"7z\xbc\xaf"sv, {"a 7z archive", kUnpack, ""}},
    Beginning{"PK\x03\x04"sv, {"a zip archive", "unpack it first; from a 3MF model, export a mesh", ""}},
    Beginning{"glTF"sv, {"a binary glTF model", kExport, ""}},
    Beginning{"Kaydara FBX"sv, {"an FBX model", kExport, ""}},
    Beginning{"; FBX"sv, {"an FBX model", kExport, ""}},
    Beginning{"BLENDER"sv, {"a Blender file", kExport, ""}},
    Beginning{"#VRML"sv, {"a VRML model", kExport, ""}},
    Beginning{"ISO-10303-21;"sv, {"a STEP model", kExport, ""}},
    Beginning{"# vtk DataFile"sv, {"a VTK file", kExport, ""}},
    Beginning{"$MeshFormat"sv, {"a Gmsh mesh", kExport, ""}},
    Beginning{"\x89PNG"sv, {"a PNG picture", kCheck, ""}},
    Beginning{"\xff\xd8\xff"sv, {"a JPEG picture", kCheck, ""}},
    Beginning{"%PDF-"sv, {"a PDF document", kCheck, ""}},
    Beginning{"\x7f\x45LF"sv, {"a program", kCheck, ""}},
    Beginning{"%%MatrixMarket"sv, {"a Matrix Market file", kCheck, ""}},
    Beginning{"version https://git-lfs"sv, {"a pointer of Git LFS", "fetch the file with git lfs pull", ""}},
    Beginning{"\xff\xfe\0\0"sv, {"UTF-32 text", kEncode, ""}},
    Beginning{"\0\0\xfe\xff"sv, {"UTF-32 text", kEncode, ""}},
    Beginning{"\xff\xfe"sv, {"UTF-16 text", kEncode, ""}},
    Beginning{"\xfe\xff"sv, {"UTF-16 text", kEncode, ""}},
};

// The same, ignoring case and leading blanks; `whole`: only as a word of its own.
struct Word {
  std::string_view word;
  bool whole;
  FileKind kind;
};

constexpr std::array kWords = {
    Word{"<!doctype html"sv, false, {"a web page", kDownload, ""}},
    Word{"<html"sv, false, {"a web page", kDownload, ""}},
    Word{"<?xml"sv, false, {"an XML file", kExport, ""}},
    Word{"<collada"sv, false, {"a COLLADA model", kExport, ""}},
    Word{"off"sv, true, {"an OFF mesh", kExport, ""}},
    Word{"coff"sv, true, {"an OFF mesh", kExport, ""}},
    Word{"noff"sv, true, {"an OFF mesh", kExport, ""}},
    Word{"ply"sv, true, {"a PLY mesh", "name it .ply", ".ply"}},
};

constexpr FileKind kObj = {"an OBJ mesh", "name it .obj", ".obj"};
constexpr FileKind kStl = {"an STL mesh", "name it .stl", ".stl"};

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool begins_with_word(std::string_view text, std::string_view word, bool whole) {
  if (text.size() < word.size() + whole) return false;
  const bool same =
      std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) { return a == lower(b); });
  return same && (!whole || is_blank(text[word.size()]));
}

// Letters with a zero byte before or after each, and no mark.
bool is_unmarked_utf16(std::string_view bytes) {
  if (bytes.size() < 8) return false;
  const int zero_at = bytes[0] == '\0' ? 0 : 1;
  for (int i = 0; i < 8; ++i) {
    if ((bytes[i] == '\0') != (i % 2 == zero_at)) return false;
  }
  return true;
}

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() <= 84) return false;
  const auto count = from_bytes<std::uint32_t>(bytes.data() + 80, ByteOrder::little);
  return bytes.size() == 84 + 50 * static_cast<std::size_t>(count);
}

bool is_3ds(std::string_view bytes) {
  return bytes.starts_with("MM") && bytes.size() > 6 &&
         from_bytes<std::uint32_t>(bytes.data() + 2, ByteOrder::little) == bytes.size();
}

// Its first line that is not a comment begins as OBJ lines do.
bool is_obj(std::string_view text) {
  while (!text.empty()) {
    const std::size_t start = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    text.remove_prefix(start);
    if (!text.starts_with('#')) break;
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
  }
  for (const char* word : {"v", "vn", "vt", "o", "g", "mtllib", "usemtl"}) {
    if (text.starts_with(word) && begins_with_word(text, word, true)) return true;
  }
  return false;
}

}  // namespace

std::optional<FileKind> file_kind(std::string_view bytes) {
  if (is_binary_stl(bytes)) return kStl;  // first: its first 80 bytes are free, and may look like anything
  for (const Beginning& b : kBeginnings) {
    if (bytes.starts_with(b.bytes)) return b.kind;
  }
  if (is_unmarked_utf16(bytes)) return FileKind{"UTF-16 text", kEncode, ""};
  if (is_3ds(bytes)) return FileKind{"a 3DS model", kExport, ""};
  while (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  std::string_view text = bytes;
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  for (const Word& w : kWords) {
    if (begins_with_word(text, w.word, w.whole)) return w.kind;
  }
  const std::string_view start = text.substr(0, 4096);
  if (text.starts_with('{') && start.find("\"asset\"") != std::string_view::npos)
    return FileKind{"a glTF model", kExport, ""};
  const auto has_facet = [&] {
    return start.find("facet") != std::string_view::npos || start.find("FACET") != std::string_view::npos;
  };
  if (begins_with_word(text, "solid", true) && has_facet()) return kStl;
  if (is_obj(text)) return kObj;
  return std::nullopt;
}

}  // namespace fc

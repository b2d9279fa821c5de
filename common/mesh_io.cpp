// Opening a mesh file, and reading words and numbers from it.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <system_error>

#include "common/mesh_formats.hpp"

namespace fc {
namespace mesh_formats {

void MeshFile::fail(const std::string& message) const {
  throw InputError({path.string(), 0, 0}, message);
}

void MeshFile::require_text(const char* format) const {
  if (bytes.find('\0') != std::string::npos) {
    fail(std::string("holds binary data, so it is not ") + format + "; check the file's name and content");
  }
}

std::string quoted(std::string_view word) {
  std::string result(word.substr(0, 24));
  for (char& c : result) {
    if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
  }
  return "'" + result + (word.size() > 24 ? "..." : "") + "'";
}

bool TextCursor::at_line_end() {
  const std::string& s = file_->bytes;
  while (at_ < s.size() && (s[at_] == ' ' || s[at_] == '\t' || s[at_] == '\r')) ++at_;
  return at_ >= s.size() || s[at_] == '\n';
}

void TextCursor::next_line() {
  at_ = std::min(file_->bytes.find('\n', at_), file_->bytes.size());
  if (at_ < file_->bytes.size()) ++at_;
  line_start_ = last_ = at_;
  ++line_;
}

std::string_view TextCursor::word() {
  const bool none = at_line_end();
  last_ = at_;
  if (none) return {};
  const std::string& s = file_->bytes;
  while (at_ < s.size() && s[at_] != ' ' && s[at_] != '\t' && s[at_] != '\r' && s[at_] != '\n') ++at_;
  return std::string_view(s).substr(last_, at_ - last_);
}

std::string_view TextCursor::word_across_lines() {
  while (at_line_end() && !at_end()) next_line();
  return word();
}

double TextCursor::number(const char* what) {
  std::string_view text = word();
  if (text.empty()) fail(std::string("the line ends where ") + what + " should stand; complete it");
  const std::string_view whole = text;
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) {
    value = std::strtod(std::string(text).c_str(), nullptr);  // 0 or infinity
  } else if (error != std::errc() || end != text.data() + text.size()) {
    fail("expected " + std::string(what) + ", found " + quoted(whole) + "; write a number");
  }
  return value;
}

double TextCursor::coordinate(const char* what) {
  return checked_coordinate(number(what), *this);
}

long long TextCursor::integer(const char* what) {
  const std::string_view text = word();
  if (text.empty()) fail(std::string("the line ends where ") + what + " should stand; complete it");
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    fail("expected " + std::string(what) + ", found " + quoted(text) + "; write a whole number");
  }
  return value;
}

void TextCursor::fail(const std::string& message) const {
  throw InputError(mark(), message);
}

namespace {

MeshFile read_whole(const std::filesystem::path& path) {
  MeshFile file{path, {}};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) file.fail("no such file; check the path");
  if (std::filesystem::is_directory(status)) file.fail("is a folder; name a mesh file in it");
  if (!std::filesystem::is_regular_file(status)) file.fail("is not a regular file; name a mesh file");
  const auto size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) file.fail("cannot be read; check its permissions");
  if (size == 0) file.fail("is empty; export the mesh again");
  file.bytes.resize(size);
  stream.read(file.bytes.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size))
    file.fail("cannot be read to its end; try again");
  return file;
}

}  // namespace
}  // namespace mesh_formats

TriangleMesh load_mesh(const std::filesystem::path& path) {
  using namespace mesh_formats;
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const MeshFile file = read_whole(path);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".stl") return read_stl(file);
  if (extension == ".ply") return read_ply(file);
  file.fail("has an extension that names no mesh format we read; convert it to .obj, .stl or .ply");
}

}  // namespace fc

// What the readers of the mesh formats share. Only load_mesh and the readers include this.
#pragma once

#include <charconv>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/errors.hpp"
#include "common/mesh.hpp"
#include "common/polygons.hpp"

namespace fc::mesh_formats {

// Coordinates beyond this are refused: the inertia, a fifth power of lengths, would leave the range of a
// double.
constexpr double kMaxCoordinate = 1e30;  // m

// The whole content of a mesh file.
struct MeshFile {
  std::filesystem::path path;
  std::string bytes;

  [[noreturn]] void fail(const std::string& message) const;  // "path: message"
  void require_text(const char* format) const;               // no NUL byte: binary junk has some
};

TriangleMesh read_obj(const MeshFile& file);
TriangleMesh read_stl(const MeshFile& file);
TriangleMesh read_ply(const MeshFile& file);

// Words and numbers of a text, with their places.
class TextCursor {
 public:
  explicit TextCursor(const MeshFile& file, std::size_t begin = 0, int line = 1)
      : file_(&file), at_(begin), line_start_(begin), line_(line) {}

  bool at_end() const { return at_ >= file_->bytes.size(); }
  std::size_t offset() const { return at_; }
  std::size_t bytes_left() const { return file_->bytes.size() - at_; }
  // The rest of the line is empty.
  bool at_line_end();
  void next_line();
  // The next word of this line; empty at the line's end.
  std::string_view word();
  // The next word of this or a later line; empty at the file's end.
  std::string_view word_across_lines();
  // The next word of this line as a number. `what` names it in the message if it is none.
  double coordinate(const char* what);
  double number(const char* what);
  long long integer(const char* what);

  // Stops reading, pointing to the last word, or to the place where one is missing.
  [[noreturn]] void fail(const std::string& message) const;
  SourceMark mark() const { return {file_->path.string(), line_, static_cast<int>(last_ - line_start_) + 1}; }

 private:
  const MeshFile* file_;
  std::size_t at_, line_start_, last_ = 0;
  int line_;
};

// A word of a file as a message may show it: in quotes, short, printable.
std::string quoted(std::string_view word);

// Throws (through `cursor_or_file.fail`) unless the coordinate is finite and at most kMaxCoordinate.
template <class Place>
double checked_coordinate(double x, const Place& place) {
  if (!(x >= -kMaxCoordinate && x <= kMaxCoordinate)) {
    place.fail("a coordinate is not finite, or beyond 1e30 m; export the mesh again");
  }
  return x;
}

}  // namespace fc::mesh_formats

// Wavefront OBJ: the lines "v x y z" and "f a b c ...". Everything else of the format is about looks, and is
// passed over.
//
// A reader of our own: tinyobjloader takes a number that it cannot read for 0, does not say in which line an
// index is out of range, rounds the last digit of a coordinate wrongly, and splits concave quadrilaterals
// along a diagonal outside.
#include <limits>

#include "common/mesh_formats.hpp"

namespace fc::mesh_formats {
namespace {

struct ObjReader {
  TextCursor cursor;
  PolygonSoup soup;
  int largest_index = -1;  // that a face named so far, and where
  SourceMark largest_index_mark;

  void vertex() {
    const double x = cursor.coordinate("the x coordinate");
    const double y = cursor.coordinate("the y coordinate");
    const double z = cursor.coordinate("the z coordinate");
    soup.vertices.emplace_back(x, y, z);  // a weight or a colour may follow
  }

  // One corner "v", "v/t", "v//n" or "v/t/n"; negative indices count back from the last vertex.
  int corner(std::string_view word) {
    const std::string_view index_text = word.substr(0, word.find('/'));
    long long index = 0;
    const auto [end, error] =
        std::from_chars(index_text.data(), index_text.data() + index_text.size(), index);
    const bool too_long = error == std::errc::result_out_of_range;
    if (error == std::errc::invalid_argument || end != index_text.data() + index_text.size()) {
      cursor.fail("expected a vertex index, found " + quoted(word) +
                  "; write 'f 1 2 3' or 'f 1/1/1 2/2/2 3/3/3'");
    }
    const auto count = static_cast<long long>(soup.vertices.size());
    if (index == 0 && !too_long)
      cursor.fail("vertex index 0; OBJ counts vertices from 1: export the mesh again");
    if (too_long || index < -count || index > std::numeric_limits<int>::max()) {
      cursor.fail("vertex index " + quoted(index_text) + " is out of range: the file has " +
                  std::to_string(count) + " vertices up to this line; export the mesh again");
    }
    const int zero_based = static_cast<int>(index > 0 ? index - 1 : count + index);
    if (zero_based > largest_index) {  // a face may name a vertex that a later line defines
      largest_index = zero_based;
      largest_index_mark = cursor.mark();
    }
    return zero_based;
  }

  void face() {
    int size = 0;
    for (std::string_view word = cursor.word(); !word.empty() && word.front() != '#'; word = cursor.word()) {
      if (word == "\\") {  // the face goes on in the next line
        cursor.next_line();
        continue;
      }
      soup.corners.push_back(corner(word));
      ++size;
    }
    if (size < 3) cursor.fail("a face with fewer than three corners; complete it, or remove its line");
    if (size > kMaxCorners) cursor.fail("a face with more than 10000 corners; export the mesh as triangles");
    soup.sizes.push_back(size);
  }
};

}  // namespace

TriangleMesh read_obj(const MeshFile& file) {
  file.require_text("an OBJ mesh");
  ObjReader reader{TextCursor(file), {}, -1, {}};
  for (; !reader.cursor.at_end(); reader.cursor.next_line()) {
    const std::string_view keyword = reader.cursor.word();
    if (keyword == "v") reader.vertex();
    if (keyword == "f") reader.face();
  }
  const auto count = static_cast<int>(reader.soup.vertices.size());
  if (reader.soup.sizes.empty()) {
    file.fail("has no triangles; an OBJ mesh needs lines 'v x y z' and 'f a b c'");
  }
  if (reader.largest_index >= count) {
    throw InputError(reader.largest_index_mark, "vertex index " + std::to_string(reader.largest_index + 1) +
                                                    " is out of range: the file has " +
                                                    std::to_string(count) +
                                                    " vertices; export the mesh again");
  }
  return triangulate(std::move(reader.soup));
}

}  // namespace fc::mesh_formats

// STL: triangles as three positions each, in text or binary. The normals in the file are not used: the order
// of the corners says which side is outside.
#include <cctype>
#include <cstdint>
#include <cstring>

#include "common/byte_order.hpp"
#include "common/mesh_formats.hpp"

namespace fc::mesh_formats {
namespace {

constexpr std::size_t kHeaderBytes = 80 + 4;           // free text, number of triangles
constexpr std::size_t kTriangleBytes = 4 * 3 * 4 + 2;  // normal, three corners, attribute

TriangleMesh read_binary(const MeshFile& file) {
  const std::size_t size = file.bytes.size();
  if (size < kHeaderBytes)
    file.fail("is too short for an STL mesh: it is truncated or of another format; export the mesh again");
  const auto count = from_bytes<std::uint32_t>(file.bytes.data() + 80, ByteOrder::little);
  if (count == 0) file.fail("has no triangles; export the mesh again");
  if (size != kHeaderBytes + count * kTriangleBytes) {
    file.fail("announces " + std::to_string(count) + " triangles, for which a binary STL file needs " +
              std::to_string(kHeaderBytes + count * kTriangleBytes) + " bytes, but has " +
              std::to_string(size) +
              " bytes: it is truncated, damaged or of another format; export the mesh again");
  }
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * static_cast<std::size_t>(count));
  mesh.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    const char* corners = file.bytes.data() + kHeaderBytes + t * kTriangleBytes + 12;  // after the normal
    for (int i = 0; i < 9; i += 3) {
      Vec3 v;
      for (int axis = 0; axis < 3; ++axis) {
        v[axis] = checked_coordinate(from_bytes<float>(corners + 4 * (i + axis), ByteOrder::little), file);
      }
      mesh.vertices.push_back(v);
    }
    const int first = static_cast<int>(3 * t);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

void expect(TextCursor& cursor, std::initializer_list<const char*> words) {
  for (const char* expected : words) {
    const std::string_view found = cursor.word_across_lines();
    if (found == expected) continue;
    cursor.fail(found.empty() ? std::string("the file ends where '") + expected +
                                    "' should stand: it is truncated; export the mesh again"
                              : std::string("expected '") + expected + "', found " + quoted(found) +
                                    "; export the mesh again");
  }
}

TriangleMesh read_ascii(const MeshFile& file) {
  TextCursor cursor(file);
  TriangleMesh mesh;
  cursor.next_line();  // "solid", a name
  bool ended = false;
  for (std::string_view word = cursor.word_across_lines(); !word.empty(); word = cursor.word_across_lines()) {
    if (word == "endsolid" ||
        word == "solid") {  // the rest of the line is a name; several solids make one mesh
      ended = word == "endsolid";
      cursor.next_line();
      continue;
    }
    if (word != "facet") {
      cursor.fail("expected 'facet' or 'endsolid', found " + quoted(word) + "; export the mesh again");
    }
    cursor.next_line();  // the normal
    expect(cursor, {"outer", "loop"});
    const int first = static_cast<int>(mesh.vertices.size());
    for (int i = 0; i < 3; ++i) {
      expect(cursor, {"vertex"});
      const double x = cursor.coordinate("the x coordinate");
      const double y = cursor.coordinate("the y coordinate");
      const double z = cursor.coordinate("the z coordinate");
      mesh.vertices.emplace_back(x, y, z);
    }
    expect(cursor, {"endloop", "endfacet"});
    mesh.triangles.push_back({first, first + 1, first + 2});
    ended = false;
  }
  if (!ended) cursor.fail("the file ends without 'endsolid': it is truncated; export the mesh again");
  if (mesh.triangles.empty()) file.fail("has no triangles; export the mesh again");
  return mesh;
}

// Many programs write binary files whose free text begins with "solid", so that word alone decides nothing.
// But the number of triangles of a binary file has a zero byte (up to 16 million of them), and a text has
// none.
bool is_ascii(const MeshFile& file) {
  const std::string& s = file.bytes;
  std::size_t start = 0;
  while (start < s.size() && std::isspace(static_cast<unsigned char>(s[start]))) ++start;
  return s.compare(start, 5, "solid") == 0 && s.find('\0') == std::string::npos;
}

}  // namespace

TriangleMesh read_stl(const MeshFile& file) {
  return is_ascii(file) ? read_ascii(file) : read_binary(file);
}

}  // namespace fc::mesh_formats

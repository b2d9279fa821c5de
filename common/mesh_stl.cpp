// STL: triangles as three positions each, in text or binary. The normals in the file are not used: the order
// of the corners says which side is outside. Keywords of a text may be in capitals.
#include <algorithm>
#include <cctype>
#include <cstdint>

#include "common/byte_order.hpp"
#include "common/mesh_formats.hpp"
#include "common/text.hpp"

namespace fc::mesh_formats {
namespace {

constexpr std::size_t kHeaderBytes = 80 + 4;           // free text, number of triangles
constexpr std::size_t kTriangleBytes = 4 * 3 * 4 + 2;  // normal, three corners, attribute

ReadMesh read_binary(const InputFile& file) {
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
  return {std::move(mesh), ""};
}

bool same_word(std::string_view found, std::string_view keyword) {
  return std::equal(found.begin(), found.end(), keyword.begin(), keyword.end(),
                    [](char f, char k) { return std::tolower(static_cast<unsigned char>(f)) == k; });
}

void expect(TextCursor& cursor, std::initializer_list<const char*> words) {
  for (const char* expected : words) {
    const std::string_view found = cursor.word_across_lines();
    if (same_word(found, expected)) continue;
    cursor.fail(found.empty() ? std::string("the file ends where '") + expected +
                                    "' should stand: it is truncated; export the mesh again"
                              : std::string("expected '") + expected + "', found " + in_quotes(found) +
                                    "; export the mesh again");
  }
}

// The rest of a line "solid NAME" or "endsolid NAME". Without line ends in the file, triangles would be taken
// for a name.
void pass_over_name(TextCursor& cursor) {
  bool after_facet = false;
  for (std::string_view word = cursor.word(); !word.empty(); word = cursor.word()) {
    if (after_facet && same_word(word, "normal"))
      cursor.fail("'facet normal' stands in the line of the solid's name; begin a new line before it");
    after_facet = same_word(word, "facet");
  }
}

// The three numbers of a normal, which is not used: "-nan(ind)" and "1.#QNAN" stand for it in files of
// programs that divided by zero.
void pass_over_normal(TextCursor& cursor) {
  expect(cursor, {"normal"});
  for (const char* what : {"the normal's x", "the normal's y", "the normal's z"}) {
    const std::string_view word = cursor.word();
    if (word.find('#') == std::string_view::npos) cursor.number(word, what);
  }
}

void read_facet(TextCursor& cursor, TriangleMesh& mesh) {
  pass_over_normal(cursor);
  expect(cursor, {"outer", "loop"});
  const int first = static_cast<int>(mesh.vertices.size());
  for (int i = 0; i < 3; ++i) {
    expect(cursor, {"vertex"});
    const double x = checked_coordinate(cursor.number("the x coordinate"), cursor);
    const double y = checked_coordinate(cursor.number("the y coordinate"), cursor);
    const double z = checked_coordinate(cursor.number("the z coordinate"), cursor);
    mesh.vertices.emplace_back(x, y, z);
  }
  expect(cursor, {"endloop", "endfacet"});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

ReadMesh read_ascii(InputFile& file) {
  make_text(file, "an STL mesh in text");
  TextCursor cursor(file);
  TriangleMesh mesh;
  bool in_solid = false;
  for (std::string_view word = cursor.word_across_lines(); !word.empty(); word = cursor.word_across_lines()) {
    if (same_word(word, in_solid ? "endsolid" : "solid")) {  // several solids make one mesh
      in_solid = !in_solid;
      pass_over_name(cursor);
    } else if (in_solid && same_word(word, "facet")) {
      read_facet(cursor, mesh);
    } else {
      cursor.fail(std::string(in_solid ? "expected 'facet' or 'endsolid', found "
                                       : "expected 'solid' or the end of the file, found ") +
                  in_quotes(word) + "; export the mesh again");
    }
  }
  if (in_solid) cursor.fail("the file ends without 'endsolid': it is truncated; export the mesh again");
  if (mesh.triangles.empty()) file.fail("has no triangles; export the mesh again");
  return {std::move(mesh), ""};
}

// Many programs write binary files whose free text begins with "solid", so that word alone decides nothing.
// The size that the number of triangles demands does. Where the size does not fit, a file without a zero byte
// is text: every number up to 16 million has one.
bool is_ascii(const InputFile& file) {
  const auto kind = file_kind(file.bytes);
  const bool is_binary =
      file.bytes.size() >= kHeaderBytes &&
      file.bytes.size() == kHeaderBytes + kTriangleBytes * from_bytes<std::uint32_t>(file.bytes.data() + 80,
                                                                                     ByteOrder::little);
  if (is_binary) return false;
  refuse_other_kind(file, "an STL mesh", ".stl");
  return kind.has_value() || file.bytes.find('\0') == std::string::npos;
}

}  // namespace

ReadMesh read_stl(InputFile& file) {
  return is_ascii(file) ? read_ascii(file) : read_binary(file);
}

}  // namespace fc::mesh_formats

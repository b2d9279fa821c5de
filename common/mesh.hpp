// Triangle meshes: the data, what is wrong with them, and how they are made ready for collision.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/types.hpp"

namespace fc {

// An indexed triangle mesh. Triangles are counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;                 // #V, metres, the shape's own frame
  std::vector<std::array<int, 3>> triangles;  // #F, indices into vertices
};

// What was found in a mesh file, in numbers, and what prepare_mesh did about it.
struct MeshReport {
  int vertices = 0;              // after equal positions were merged
  int triangles = 0;             // after degenerate and duplicate ones were removed
  int merged_vertices = 0;       // equal positions, or never used
  int degenerate_triangles = 0;  // zero area (the rule stands at prepare_mesh); removed
  // The same three corners as an earlier one; removed (in the other orientation: not from a closed mesh,
  // where it may be the other side of an inner wall).
  int duplicate_triangles = 0;
  int boundary_edges = 0;       // edges of one triangle
  int holes = 0;                // closed loops (connected sets) of boundary edges
  int nonmanifold_edges = 0;    // edges of three or more triangles
  int flipped_edges = 0;        // edges whose two triangles disagree in orientation
  int flipped_triangles = 0;    // that face against most of those they are joined to over edges of two
  int one_sided = 0;            // such sets that cannot face one way, like a Moebius band: none counted above
  int components = 0;           // sets of triangles connected over shared edges
  bool inside_out = false;      // a component faced inwards without being a cavity, and was reversed
  int reversed_components = 0;  // how many
  bool solid = false;           // closed and consistently oriented, with a volume: it has an inside
  int overlapping = 0;          // components of a solid that share volume with another: it counts in each
  std::string left_out;         // what load_mesh did not read

  // One line for people: "69,666 triangles, 34,835 vertices, closed, consistently oriented, 1 component", or
  // the defects.
  std::string text() const;
};

struct PreparedMesh {
  TriangleMesh mesh;
  MeshReport report;
};

// Reads Wavefront OBJ, STL (ASCII or binary) or PLY (ASCII or binary, both byte orders, faces or triangle
// strips), by the file's extension. A text may begin with a byte order mark and end its lines with \n, \r\n or
// \r. Polygons are split into triangles that cover them, concave ones too; colours, normals and other extras
// are ignored. The file's content is returned as it stands: an STL file repeats each vertex, and nothing is
// merged or reversed yet. `left_out` receives what else the file places in space, such as "3 lines" of an OBJ
// file; it is empty otherwise. Throws InputError with the file's name and, in text formats, line and column:
// not found, a folder, empty, unreadable, truncated, of another format than its name says, a line that begins
// with an unknown word, an index out of range, a coordinate that is not finite or beyond 1e30 m, no triangles.
// Memory is reserved only for what the file can hold, whatever its header announces.
TriangleMesh load_mesh(const std::filesystem::path& file, std::string* left_out = nullptr);

// Makes a mesh ready for collision: merges vertices at equal positions (exactly equal; -0 equals 0), drops
// degenerate and duplicate triangles and unused vertices, reverses inside-out components, and reports all of
// it. What remains keeps its order, and positions do not move.
//
// A triangle is degenerate if two corners are equal, if its corners lie exactly on one line (decided without
// rounding), or if it is so thin that its normal (b - a) x (c - a) is zero in doubles. Thicker triangles
// stay. A triangle on one line still counts for the edges: it may be what joins a long edge to the two short
// ones beside it, so that nothing leaks.
//
// A mesh is solid if each edge is used as often in one direction as in the other, and if it encloses more
// than the rounding of its volume. Edges of four triangles may belong to a solid (two cubes that share an
// edge).
//
// The orientation of a solid's components: if the whole signed volume is negative, all are reversed. A
// component that then still has a negative volume is a cavity if its bounding box lies in that of an outward
// one, and stays; if not, it cannot be a cavity, and is reversed. The limit: an inside-out component beside,
// not inside, another one but within that one's bounding box (a ball in the crook of an L) is taken for a
// cavity. A component that crosses itself is not detected; components that overlap are counted, and the volume
// that they share is mass in each of them.
PreparedMesh prepare_mesh(const TriangleMesh& mesh);

// Signed volume of a closed mesh in m^3 (positive if its triangles face outward): sum of a.(b x c)/6.
double signed_volume(const TriangleMesh& mesh);

}  // namespace fc

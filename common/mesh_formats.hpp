// What the readers of the mesh formats share. Only load_mesh and the readers include this.
#pragma once

#include <string>
#include <vector>

#include "common/input_file.hpp"
#include "common/mesh.hpp"
#include "common/polygons.hpp"
#include "common/text_cursor.hpp"

namespace fc::mesh_formats {

// Coordinates beyond this are refused: the inertia, a fifth power of lengths, would leave the range of a
// double.
constexpr double kMaxCoordinate = 1e30;  // m

struct ReadMesh {
  TriangleMesh mesh;
  std::string left_out;  // what else has a place in space: "3 lines, 2 points"
};

// Each reader owns the file while it reads, and may change its bytes.
ReadMesh read_obj(InputFile& file);
ReadMesh read_stl(InputFile& file);
ReadMesh read_ply(InputFile& file);

// Throws (through `cursor_or_file.fail`) unless the coordinate is finite and at most kMaxCoordinate.
template <class Place>
double checked_coordinate(double x, const Place& place) {
  if (!(x >= -kMaxCoordinate && x <= kMaxCoordinate)) {
    place.fail("a coordinate is not finite, or beyond 1e30 m; export the mesh again");
  }
  return x;
}

}  // namespace fc::mesh_formats

// Shapes as triangles, for display only: nothing here takes part in a computation.
#pragma once

#include <array>
#include <vector>

#include "common/shape.hpp"

namespace fc {

struct DisplayMesh {
  std::vector<float> positions;               // 3 per vertex, m, about the centre of mass
  std::vector<float> normals;                 // 3 per vertex, unit; empty: to be drawn flat, face by face
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from outside
};

// Spheres and capsules are tessellated, with exact normals; a mesh of many triangles gets smooth normals;
// boxes, hulls and coarse meshes are drawn flat.
DisplayMesh display_mesh(const Shape& shape);

// An arrow of length 1 from the origin along +z, with a ball at its tail.
DisplayMesh arrow_mesh();

}  // namespace fc

// Polygons, and their splitting into triangles.
#pragma once

#include <vector>

#include "common/mesh.hpp"

namespace fc {

// Polygons of any number of corners, as mesh files and hulls have them.
struct PolygonSoup {
  std::vector<Vec3> vertices;
  std::vector<int> corners;  // of all polygons, one after the other
  std::vector<int> sizes;    // number of corners of each polygon, at least 3
};

// Splits the polygons into triangles that cover them, concave ones too (ears are cut off one by one; convex
// ones become fans). Corners must be valid indices. A polygon that crosses itself becomes a fan.
TriangleMesh triangulate(PolygonSoup soup);

// The largest polygon that is split: the time for cutting ears grows with the square of its size.
constexpr int kMaxCorners = 10'000;
}  // namespace fc

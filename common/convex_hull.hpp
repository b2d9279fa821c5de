// Convex hulls of point sets, by Qhull.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/mesh.hpp"

namespace fc {

// The indices (ascending) of the points that are vertices of the convex hull of `points`. Where the set spans
// no volume (flat, or fewer than four points), or Qhull gives up, the result is all indices: for a support
// mapping a superset is always correct. A point that is left out may lie outside the hull of the others by
// rounding: by less than kHullRounding times the largest extent of the points.
constexpr double kHullRounding = 1e-14;
std::vector<int> hull_vertices(std::span<const Vec3> points);

// The hull's surface as a closed mesh of outward triangles; only hull vertices are kept, in the order of
// `points`. Coplanar points of a face give several triangles in one plane. Empty if the points span no
// volume.
std::optional<TriangleMesh> hull_mesh(std::span<const Vec3> points);

}  // namespace fc

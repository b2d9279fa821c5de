// Where a plane touches a curved shape: the outline from which contact points are made.
#pragma once

#include <array>

#include "ch01_convex_advancement/query.hpp"
#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// The part of a cylinder or a cone that faces a direction: a cap, a line of its side, or one point of a rim (or
// the apex). All of it lies on the true surface.
struct Outline {
  static constexpr int kRim =
      8;  // number of points on the rim that stand for a cap, the farthest along the direction first
  std::array<Vec3, kRim> corners;  // m, shape axes; of a cap anticlockwise as seen from outside
  int count = 0;                   // kRim, 2 or 1
  Vec3 normal = Vec3::UnitZ();     // unit, outward, of the cap or of the side along its line; not of a point
  ca::FeatureKind kind = ca::FeatureKind::vertex;
  // Faces: 0 the lower cap, 1 the upper, 2 the side. Edges: 0 the lower rim, 1 the upper. Vertex: 1, the
  // apex.
  int id = 0;
};

// A cap, or the side, counts if its normal is within a tenth (sine of the angle) of the direction; beyond
// that, at most one of its points can be in contact. `direction`: unit, shape axes.
Outline outline_of(const Model& curved, const Vec3& direction);

}  // namespace fc::hulls

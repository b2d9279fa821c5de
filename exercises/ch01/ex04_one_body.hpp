// Exercise 1.4: one body instead of two.
#pragma once

#include <vector>

#include "common/types.hpp"

namespace fc::exercises {

// The convex hull of points, rounded by a ball: a sphere is one point, a capsule two.
struct Rounded {
  std::vector<Vec3> points;          // m, body axes; at least one
  double radius = 0;                 // m
  Mat3 rotation = Mat3::Identity();  // body axes to world axes
  Vec3 position = Vec3::Zero();      // m, where the body's origin is in the world
};

// The point (world, m) of the body, its ball included, that lies farthest along `direction` (world, any
// length but 0), up to rounding.
Vec3 support(const Rounded& body, const Vec3& direction);

// The same for the Minkowski difference B - A = { b - a : b in B, a in A }: a body of its own, which contains
// the origin exactly if A and B have a point in common.
Vec3 difference_support(const Rounded& a, const Rounded& b, const Vec3& direction);

// The same for everything that B - A sweeps over while B flies straight by `travel` (world, m) and A stays.
Vec3 swept_support(const Rounded& a, const Rounded& b, const Vec3& travel, const Vec3& direction);

// The smallest gap (m) along n (unit, world, from A to B) during all of that flight; negative if the slab
// closes. If it is > 0, A and B certainly never meet on the way: rounding may make it smaller than the exact
// one, by at most 1e-12 of the largest distance of the bodies' points from the origin, but never larger.
double gap_on_the_way(const Rounded& a, const Rounded& b, const Vec3& travel, const Vec3& n);

}  // namespace fc::exercises

// Two bodies that slide past each other: the plane between them.
//
// Where two boxes of a floor are flush, a body that slides over the seam comes as near to the next box's side as to its
// top. The nearest points do not tell the two faces apart: within the tolerance their normal may point anywhere between
// the two faces' normals. But convex bodies meet only if the gap closes along every plane between them. So the faces
// beside the nearest points of a near pair are examined: if one of them separates the two bodies, and they do not close
// in along it, this plane is the one that counts.
#pragma once

#include <optional>
#include <vector>

#include "ch01_convex_advancement/query.hpp"
#include "ch02_hull_hierarchy/model_distance.hpp"

namespace fc::world {

// Places on the two cores that are near each other: m, world axes, from A's centre of mass. (The ball that rounds a
// core looks the same in all directions: turning brings it no nearer.)
struct Witnesses {
  Vec3 point_a, point_b;
};

// Two models with their motions, and their pose at one time (s), at which they are examined.
struct NearPair {
  const hulls::Model& a;
  const ca::Motion& motion_a;
  const hulls::Model& b;
  const ca::Motion& motion_b;
  double time;
  ca::PairPose pose{motion_a, motion_b, time};

  // From places on the two surfaces, with the normal there (unit, world, from A to B).
  Witnesses cores(const Vec3& point_a, const Vec3& point_b, const Vec3& normal) const {
    return {point_a - a.radius * normal, point_b + b.radius * normal};
  }
};

// How fast A approaches B along a unit normal, at the given places (m/s).
double closing_speed(const NearPair& pair, const Vec3& normal, const Witnesses& at);

// The unit normals (world, from A to B) of the faces beside two features; and of those through the nearest points of two
// leaves.
std::vector<Vec3> faces_beside(const NearPair& pair, const ca::FeaturePair& features);
std::vector<Vec3> faces_beside(const NearPair& pair, const hulls::LeafPair& leaves, const Witnesses& at);

// The normal along which the bodies close in slowest, among those that separate them by a gap of at least `least` (m).
// None if the bodies close in faster than `fastest` (m/s) along each of these.
std::optional<Vec3> slowest_plane(const NearPair& pair, const std::vector<Vec3>& normals, const Witnesses& at,
                                  double fastest, double least);

// For how long, in s from pair.time on and up to `interval`, the gap along a plane that does not turn (normal: unit,
// world, from A to B) is sure to stay at `target` (m) or above: conservative advancement (chapter 1) along one normal.
double clear_along(const NearPair& pair, const Vec3& normal, double target, double interval);

// The certified gap along a normal (m); a mesh counts as its convex hull.
double gap_along(const NearPair& pair, const Vec3& normal);

}  // namespace fc::world

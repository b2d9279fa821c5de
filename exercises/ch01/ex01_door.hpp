// Exercise 1.1: how fast can a swinging door close in?
#pragma once

#include <vector>

#include "common/types.hpp"

namespace fc::exercises {

// A body that turns about a fixed hinge, with a spin that changes evenly: at time s its points turn about the
// line through `hinge` along `axis` with angular velocity (spin + spin_up s) axis, and do not move in any
// other way.
struct Door {
  Vec3 hinge = Vec3::Zero();  // m, world: any point of the hinge's line
  Vec3 axis = Vec3::UnitZ();  // unit, world
  double spin = 0;            // rad/s, at s = 0
  double spin_up = 0;         // rad/s^2, constant
  std::vector<Vec3> corners;  // m, world, at s = 0; the door is their convex hull
};

// An upper bound, in m/s, of n . (velocity of any point of the door) at any time from t until end (s, 0 <= t
// <= end).
//   n: unit, world; it does not move.
// No point exceeds it, not even in the last digit: what the computation may have rounded down is added. The
// bound may grow by that, but by no more than 1e-12 of (|spin| + |spin_up| end) times the distance from
// `hinge` to the corner farthest from it. It may depend on the corners' distances from the hinge's line, but
// not on where they are now, since they will turn. It is the smallest bound of this kind: if the door turns
// far enough, one of its corners comes as near to it as you like (for a constant spin, up to rounding). Not
// negative.
double door_speed_bound(const Door& door, const Vec3& n, double t, double end);

}  // namespace fc::exercises

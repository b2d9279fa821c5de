// Exercise 1.3: a squeezed ball.
#pragma once

#include "common/types.hpp"

namespace fc::exercises {

// An ellipsoid about the origin:  (x/a)^2 + (y/b)^2 + (z/c)^2 <= 1.
//   half_axes: a, b, c in m, each > 0, along the body's x, y, z.

// The point of the ellipsoid that lies farthest along `direction` (body axes, any length but 0), up to
// rounding.
Vec3 ellipsoid_support(const Vec3& half_axes, const Vec3& direction);

// The largest distance in m of any point of the ellipsoid from the line through its centre along `axis`
// (unit, body axes). Never smaller than the truth, not even in the last digit, and larger by no more than
// 1e-12 of it, also for a ball and for what is nearly one.
double ellipsoid_reach(const Vec3& half_axes, const Vec3& axis);

// The smallest bound, in m/s, of any point's velocity along n while the ellipsoid spins on, among those that
// do not depend on its present turn about the spin. The spin (rad/s) is constant and may be zero; it and n
// (unit) are given in body axes. (n is fixed in the world. Only its angle with the spin matters, and that
// does not change.) Never smaller than the truth, rounding included; larger by no more than 1e-12 of |spin|
// times the longest half axis.
double ellipsoid_speed_bound(const Vec3& half_axes, const Vec3& n, const Vec3& spin);

}  // namespace fc::exercises

// Caught by: Ex03Ellipsoid.SomePointIsAsFarFromTheAxis
// The reach from the centre, not from the axis: safe, and too large.
#include <algorithm>
#include <cmath>

#include "ex03_ellipsoid.hpp"

namespace fc::exercises {

Vec3 ellipsoid_support(const Vec3& half_axes, const Vec3& direction) {
  const Vec3 stretched = half_axes.cwiseProduct(direction.normalized());
  return half_axes.cwiseProduct(stretched.normalized());
}

double ellipsoid_reach(const Vec3& half_axes, const Vec3& axis) {
  return half_axes.maxCoeff();
}

double ellipsoid_speed_bound(const Vec3& half_axes, const Vec3& n, const Vec3& spin) {
  const double rate = spin.norm();
  return rate > 0 ? n.cross(spin).norm() * ellipsoid_reach(half_axes, spin / rate) : 0;
}

}  // namespace fc::exercises

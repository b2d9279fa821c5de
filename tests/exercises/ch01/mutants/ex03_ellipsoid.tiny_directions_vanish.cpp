// Caught by: Ex03Ellipsoid.SupportIsThatOfADirectionOfAnyLength
// The square of 1e-200 is 0, and that of 1e200 infinite.
#include "ex03_ellipsoid.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

Vec3 ellipsoid_support(const Vec3& half_axes, const Vec3& direction) {
  return half_axes.cwiseProduct(half_axes.cwiseProduct(direction.normalized()).normalized());
}

double ellipsoid_reach(const Vec3& half_axes, const Vec3& axis) {
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  const Vec3 Du = half_axes.cwiseProduct(u), Dv = half_axes.cwiseProduct(v);
  const double p = Du.squaredNorm(), q = Dv.squaredNorm(), r = Du.dot(Dv);
  return std::sqrt(0.5 * (p + q) + std::hypot(0.5 * (p - q), r)) * (1 + 4e-15);
}

double ellipsoid_speed_bound(const Vec3& half_axes, const Vec3& n, const Vec3& spin) {
  const double rate = spin.norm();
  return rate > 0 ? rate * (n.cross(spin / rate).norm() + 4e-15) * ellipsoid_reach(half_axes, spin / rate)
                  : 0;
}

}  // namespace fc::exercises

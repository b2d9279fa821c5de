// Caught by: Ex03Ellipsoid.NearlyRoundIsNoLessExact
// Trace and determinant: right on paper, and half of the digits are gone where the ellipsoid is nearly round.
#include "ex03_ellipsoid.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

Vec3 ellipsoid_support(const Vec3& half_axes, const Vec3& direction) {
  const Vec3 unit = (direction / direction.cwiseAbs().maxCoeff()).normalized();
  return half_axes.cwiseProduct(half_axes.cwiseProduct(unit).normalized());
}

double ellipsoid_reach(const Vec3& half_axes, const Vec3& axis) {
  const Vec3 d2 = half_axes.cwiseAbs2(), a2 = axis.cwiseAbs2();
  const double sum = d2.x() * (a2.y() + a2.z()) + d2.y() * (a2.z() + a2.x()) + d2.z() * (a2.x() + a2.y());
  const double product = d2.y() * d2.z() * a2.x() + d2.z() * d2.x() * a2.y() + d2.x() * d2.y() * a2.z();
  return std::sqrt(0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4 * product)))) * (1 + 4e-15);
}

double ellipsoid_speed_bound(const Vec3& half_axes, const Vec3& n, const Vec3& spin) {
  const double rate = spin.norm();
  return rate > 0 ? rate * (n.cross(spin / rate).norm() + 4e-15) * ellipsoid_reach(half_axes, spin / rate)
                  : 0;
}

}  // namespace fc::exercises

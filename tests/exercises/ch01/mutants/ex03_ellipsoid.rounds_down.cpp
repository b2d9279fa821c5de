// Caught by: Ex03Ellipsoid.ABoundHoldsToTheLastDigit
// Right but for rounding, which makes half of all results smaller than the truth.
#include "ex03_ellipsoid.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

Vec3 ellipsoid_support(const Vec3& half_axes, const Vec3& direction) {
  const Vec3 unit = (direction / direction.cwiseAbs().maxCoeff()).normalized();
  return half_axes.cwiseProduct(half_axes.cwiseProduct(unit).normalized());
}

double ellipsoid_reach(const Vec3& half_axes, const Vec3& axis) {
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  const Vec3 Du = half_axes.cwiseProduct(u), Dv = half_axes.cwiseProduct(v);
  const double p = Du.squaredNorm(), q = Dv.squaredNorm(), r = Du.dot(Dv);
  return std::sqrt(0.5 * (p + q) + std::hypot(0.5 * (p - q), r));
}

double ellipsoid_speed_bound(const Vec3& half_axes, const Vec3& n, const Vec3& spin) {
  const double rate = spin.norm();
  return rate > 0 ? n.cross(spin).norm() * ellipsoid_reach(half_axes, spin / rate) : 0;
}

}  // namespace fc::exercises

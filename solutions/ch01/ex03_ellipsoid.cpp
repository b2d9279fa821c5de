#include "ex03_ellipsoid.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

// The ellipsoid is a ball whose points u were stretched: x = D u with D = diag(a, b, c). So d.x = (D d).u,
// which is largest for u along D d.
Vec3 ellipsoid_support(const Vec3& half_axes, const Vec3& direction) {
  const Vec3 stretched = half_axes.cwiseProduct(direction.normalized());
  return half_axes.cwiseProduct(stretched.normalized());
}

// The squared distance of x = D u from the axis is |P D u|^2 with P = 1 - axis axis^T, so its largest value
// is the largest eigenvalue of D P D. One eigenvalue is 0 (P has rank 2); the other two have the sum T =
// trace(D P D) and the product S, the sum of the 2 by 2 minors, which are D_i^2 D_j^2 axis_k^2.
double ellipsoid_reach(const Vec3& half_axes, const Vec3& axis) {
  const Vec3 d2 = half_axes.cwiseAbs2(), a2 = axis.cwiseAbs2();
  const double sum = d2.x() * (a2.y() + a2.z()) + d2.y() * (a2.z() + a2.x()) + d2.z() * (a2.x() + a2.y());
  const double product = d2.y() * d2.z() * a2.x() + d2.z() * d2.x() * a2.y() + d2.x() * d2.y() * a2.z();
  return std::sqrt(0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4 * product))));
}

double ellipsoid_speed_bound(const Vec3& half_axes, const Vec3& n, const Vec3& spin) {
  const double rate = spin.norm();
  return rate > 0 ? n.cross(spin).norm() * ellipsoid_reach(half_axes, spin / rate) : 0;
}

}  // namespace fc::exercises

#include "ex03_ellipsoid.hpp"

#include <cmath>
#include <limits>

namespace fc::exercises {
namespace {

// More than all roundings of a reach or a speed together, as a part of it: so that a bound stays one.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

// Of any length but 0: the square of a length below 1e-162 would be 0, and that of one above 1e154 infinite.
Vec3 unit(const Vec3& direction) {
  return (direction / direction.cwiseAbs().maxCoeff()).normalized();
}

}  // namespace

// The ellipsoid is a ball whose points u were stretched: x = D u with D = diag(a, b, c). So d.x = (D d).u,
// which is largest for u along D d.
Vec3 ellipsoid_support(const Vec3& half_axes, const Vec3& direction) {
  return half_axes.cwiseProduct(unit(half_axes.cwiseProduct(unit(direction))));
}

// With unit vectors u, v across the axis and each other the squared distance of x = D y from the axis is
// (Du.y)^2 + (Dv.y)^2, so its largest value over unit vectors y is the larger eigenvalue of the 2 by 2 matrix
// of the products of Du and Dv: (p + q)/2 + sqrt(((p + q)/2)^2 - (p q - r^2)). What is under the root is a
// difference of nearly equal numbers where the ellipsoid is nearly round; written as ((p - q)/2)^2 + r^2 it
// is a sum.
double ellipsoid_reach(const Vec3& half_axes, const Vec3& axis) {
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  const Vec3 Du = half_axes.cwiseProduct(u), Dv = half_axes.cwiseProduct(v);
  const double p = Du.squaredNorm(), q = Dv.squaredNorm(), r = Du.dot(Dv);
  return std::sqrt(0.5 * (p + q) + std::hypot(0.5 * (p - q), r)) * (1 + kRounding);
}

double ellipsoid_speed_bound(const Vec3& half_axes, const Vec3& n, const Vec3& spin) {
  const double rate = spin.stableNorm();
  if (rate == 0) return 0;
  const Vec3 axis = spin / rate;
  // The sine of n and the axis is a difference: what it lost is a part of 1.
  return rate * (n.cross(axis).norm() + kRounding) * ellipsoid_reach(half_axes, axis);
}

}  // namespace fc::exercises

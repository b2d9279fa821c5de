#include "ch06_friction/one_contact.hpp"

#include <algorithm>
#include <cmath>

#include "ch06_friction/slip_equation.hpp"

namespace fc::friction {
namespace {

// An eigenvalue below this share of A's largest entry is 0, and so is a d̂ below this share of the terms that cancel in
// it: about fifty units of round-off.
constexpr double kDead = 1e-14;

Vec2 turned(const Vec2& v) {
  return {-v[1], v[0]};
}

}  // namespace

// ANCHOR: factor
OneContact::OneContact(const Mat3& A, double mu)
    : mu_(mu), a_(A(0, 0)), c_(Vec2::Zero()), size_(A.cwiseAbs().maxCoeff()) {
  const Vec2 c = A.block<2, 1>(1, 0);
  const Vec2 slope = a_ > 0 ? Vec2(c / a_) : Vec2(Vec2::Zero());
  const double d11 = A(1, 1) - c[0] * slope[0], d22 = A(2, 2) - c[1] * slope[1];
  const double d12 = 0.5 * (A(1, 2) + A(2, 1)) - c[0] * slope[1];

  // The eigenvectors of a symmetric 2 by 2 matrix, by half the angle of (d11 - d22, 2 d12).
  const double angle = 0.5 * std::atan2(-2 * d12, d22 - d11);
  axis_ = {std::cos(angle), std::sin(angle)};
  const double mean = 0.5 * (d11 + d22), spread = std::hypot(0.5 * (d11 - d22), d12);
  delta_ = {(d11 * d22 - d12 * d12) / (mean + spread), mean + spread};  // their product is the determinant
  for (double& delta : delta_) {
    if (!(delta > kDead * size_)) delta = 0;
  }
  c_ = {axis_.dot(slope), turned(axis_).dot(slope)};
  one_root_ = mu_ * c_.norm() * delta_.sum() <= 2 * std::sqrt(delta_.prod());
}
// ANCHOR_END: factor

// ANCHOR: solve
Vec3 OneContact::solve(const Vec3& q) const {
  // Open.
  if (q[0] >= 0 || !(a_ > 0)) return Vec3::Zero();
  const double free = -q[0] / a_;  // r_N if there were no friction
  const Vec2 along{axis_.dot(q.tail<2>()), turned(axis_).dot(q.tail<2>())};
  Vec2 d = along - c_ * q[0];

  // Stick: u_T = 0 along directions that impulses reach; along others there must be no velocity.
  Vec2 tangent = Vec2::Zero();
  bool stops = true;
  for (int i = 0; i < 2; ++i) {
    if (delta_[i] > 0) {
      tangent[i] = -d[i] / delta_[i];
    } else if (std::abs(d[i]) <= kDead * (std::abs(along[i]) + std::abs(c_[i] * q[0]))) {
      d[i] = 0;
    } else {
      stops = false;
    }
  }
  const SlipEquation slip{mu_, free, c_, d, delta_};
  double normal = slip.normal(tangent);
  if (!stops || tangent.norm() > mu_ * normal) {
    // Slip: the tangent impulse lies on the cone, against the slip.
    if (mu_ == 0) return {free, 0, 0};
    tangent = slip.tangent(slip.least_root(one_root_));
    normal = slip.normal(tangent);
    tangent *= tangent.isZero(0) ? 0.0 : mu_ * normal / tangent.norm();
  }
  const Vec2 r = tangent[0] * axis_ + tangent[1] * turned(axis_);
  return {normal, r[0], r[1]};
}
// ANCHOR_END: solve

}  // namespace fc::friction

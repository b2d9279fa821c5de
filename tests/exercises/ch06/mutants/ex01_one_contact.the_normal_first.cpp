// Caught by: Ex06OneContact.TheNormalImpulseKnowsOfTheFriction
// The normal impulse is found without friction, and stays.
#include "ex01_one_contact.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fc::exercises {
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

// An eigenvalue below this part of A's largest entry is 0, and so is a velocity below this part of what cancels in it.
constexpr double kDead = 1e-14;
// So many pieces of the axis of α are looked at, from the left: the first change of sign is the slowest slip.
constexpr int kPieces = 200;
constexpr int kHalvings = 1200;  // more than a double has

// A contact that touches (u_N = 0), with r_N eliminated, in the eigenbasis of D̂.
struct Touching {
  double mu, free;    // free: N s, the normal impulse if there is no friction
  Vec2 c, d, d_size;  // c/a; d̂ and what was added up in it, m/s
  Vec2 delta;         // eigenvalues of D̂, 1/kg; 0 where nothing moves

  Vec2 tangent(double alpha) const { return -d.cwiseQuotient((delta.array() + alpha).matrix()); }
  double normal(const Vec2& tangent) const { return free + 0 * c.dot(tangent); }
  double excess(double alpha) const {  // f
    const Vec2 r = tangent(alpha);
    return r.norm() - mu * normal(r);
  }

  // Whether u_T = 0 is within reach, and with which tangent impulse.
  bool sticks(Vec2& r) const {
    r.setZero();
    for (int i = 0; i < 2; ++i) {
      if (delta[i] > 0) {
        r[i] = -d[i] / delta[i];
      } else if (std::abs(d[i]) > kDead * d_size[i]) {
        return false;
      }
    }
    return r.norm() <= mu * normal(r);
  }

  // The least root of f. f(0) > 0, and f < 0 from `most` on: there |r_T| <= |d̂|/α, and r_N >= free - |c||d̂|/α.
  double least_root() const {
    const double most = 2 * d.norm() * (1 + mu * c.norm()) / (mu * free);
    const double tau = delta.sum() > 0 ? delta.sum() : most;
    double low = 0, high = most;
    for (int k = 1; k < kPieces; ++k) {
      const double alpha = tau * k / (kPieces - k);
      if (alpha >= most) break;
      if (excess(alpha) <= 0) {
        high = alpha;
        break;
      }
      low = alpha;
    }
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = low + 0.5 * (high - low);
      if (middle <= low || middle >= high) break;
      (excess(middle) > 0 ? low : high) = middle;
    }
    return high;
  }
};

}  // namespace

Answer solve_contact(const Mat3& A, const Vec3& q, double mu) {
  if (!A.allFinite() || !q.allFinite() || !std::isfinite(mu) || mu < 0)
    throw std::invalid_argument("solve_contact: A, q and mu must be finite, and mu >= 0");
  const double a = A(0, 0);
  if (q[0] >= 0 || a <= 0) return {};

  const Vec2 slope = A.block<2, 1>(1, 0) / a;
  const Mat2 D = A.block<2, 2>(1, 1) - a * slope * slope.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat2> eigen(0.5 * (D + D.transpose()));
  const Mat2 axes = eigen.eigenvectors();
  const double size = A.cwiseAbs().maxCoeff();
  Touching touching{mu, -q[0] / a, axes.transpose() * slope, Vec2::Zero(), Vec2::Zero(), eigen.eigenvalues()};
  const Vec2 along = axes.transpose() * q.tail<2>();
  touching.d = along - touching.c * q[0];
  touching.d_size = along.cwiseAbs() + touching.c.cwiseAbs() * std::abs(q[0]);
  for (int i = 0; i < 2; ++i) {
    if (touching.delta[i] > kDead * size) continue;
    touching.delta[i] = 0;
    if (std::abs(touching.d[i]) <= kDead * (q.norm() + touching.d_size[i])) touching.d[i] = 0;
  }

  Answer answer{Kind::stick, Vec3::Zero()};
  Vec2 tangent;
  if (!touching.sticks(tangent)) {
    answer.kind = Kind::slip;
    // Without friction there is nothing to look for.
    tangent = mu > 0 ? touching.tangent(touching.least_root()) : Vec2(Vec2::Zero());
  }
  answer.r[0] = touching.normal(tangent);
  // The root has an error in its last digit: the cone has none.
  if (const double most = mu * answer.r[0]; answer.kind == Kind::slip && tangent.norm() > 0)
    tangent *= most / tangent.norm();
  answer.r.tail<2>() = axes * tangent;
  return answer;
}

}  // namespace fc::exercises

#include "ch06_friction/clear/one_contact.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

namespace fc::friction::clear {

// ANCHOR: one_contact
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

// An eigenvalue below this share of A's largest entry is 0, and so is a velocity below this share of the terms that
// cancel in it.
constexpr double kDead = 1e-14;
// Pieces into which the axis of α is divided. They are searched from 0 on: the first change of sign is the slowest
// slip.
constexpr int kPieces = 200;
constexpr int kHalvings = 1200;  // more than a double has

// A contact that touches: r_N is eliminated by u_N = 0, and the tangents are the eigenvectors of D̂.
struct Touching {
  double mu, free;  // free: N s, the normal impulse if there were no friction
  Vec2 c, d;        // c/a, and d̂ in m/s
  Vec2 delta;       // 1/kg, the eigenvalues of D̂

  Vec2 tangent(double alpha) const { return -d.cwiseQuotient((delta.array() + alpha).matrix()); }
  double normal(const Vec2& tangent) const { return free - c.dot(tangent); }
  double f(double alpha) const { return tangent(alpha).norm() - mu * normal(tangent(alpha)); }

  // f(0) > 0. From `most` on f < 0, since |r_T| <= |d̂|/α and r_N >= free - |c||d̂|/α there.
  double least_root() const {
    const double most = 2 * d.norm() * (1 + mu * c.norm()) / (mu * free);
    const double scale = delta.sum() > 0 ? delta.sum() : most;
    double low = 0, high = most;
    for (int k = 1; k < kPieces && high == most; ++k) {
      const double alpha = scale * k / (kPieces - k);
      if (alpha >= most) break;
      (f(alpha) > 0 ? low : high) = alpha;
    }
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = low + 0.5 * (high - low);
      if (middle <= low || middle >= high) break;
      (f(middle) > 0 ? low : high) = middle;
    }
    return high;
  }
};

}  // namespace

Answer solve_contact(const Mat3& A, const Vec3& q, double mu) {
  if (!A.allFinite() || !q.allFinite() || !std::isfinite(mu) || mu < 0)
    throw std::invalid_argument("solve_contact: A, q and mu must be finite, and mu >= 0");
  const double a = A(0, 0);
  if (q[0] >= 0 || a <= 0) return {};  // open

  // r_N is eliminated, and the tangents are turned into the eigenvectors of D̂.
  const Vec2 c = A.block<2, 1>(1, 0) / a;
  const Mat2 D = A.block<2, 2>(1, 1) - a * c * c.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat2> eigen(0.5 * (D + D.transpose()));
  const Mat2 axes = eigen.eigenvectors();
  const Vec2 along = axes.transpose() * q.tail<2>();
  Touching touching{mu, -q[0] / a, axes.transpose() * c, Vec2::Zero(), eigen.eigenvalues()};
  touching.d = along - touching.c * q[0];

  // Along a dead direction no impulse moves anything. If nothing slips along it, any δ will do; else the contact cannot
  // stick.
  const double size = A.cwiseAbs().maxCoeff();
  for (int i = 0; i < 2; ++i) {
    if (touching.delta[i] > kDead * size) continue;
    const double parts = q.norm() + std::abs(along[i]) + std::abs(touching.c[i] * q[0]);
    const bool still = std::abs(touching.d[i]) <= kDead * parts;
    touching.delta[i] = still ? size : 0;
    if (still) touching.d[i] = 0;
  }

  const bool sticks = touching.delta.minCoeff() > 0 && touching.f(0) <= 0;
  Vec2 tangent = Vec2::Zero();
  if (sticks) {
    tangent = touching.tangent(0);
  } else if (mu > 0) {
    tangent = touching.tangent(touching.least_root());
    // The root has an error in its last digit; the impulse must lie exactly on the cone.
    if (tangent.norm() > 0) tangent *= mu * touching.normal(tangent) / tangent.norm();
  }
  Answer answer{sticks ? Kind::stick : Kind::slip, Vec3::Zero()};
  answer.r << touching.normal(tangent), axes * tangent;
  return answer;
}
// ANCHOR_END: one_contact

}  // namespace fc::friction::clear

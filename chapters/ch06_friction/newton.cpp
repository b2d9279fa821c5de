#include "ch06_friction/newton.hpp"

#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "ch06_friction/start.hpp"

namespace fc::friction {
namespace {

constexpr int kSteps = 30;
// Pivots of the decomposition below this share of the largest belong to redundant contacts. If it is smaller, round-off
// in A counts as a stiffness; if larger, towers, which are truly soft, count as redundant.
constexpr double kRank = 1e-10;

// F of one contact and its derivative: dF = of_u du + of_r d(s r).
struct Piece {
  Vec3 F = Vec3::Zero();
  Mat3 of_u = Mat3::Zero(), of_r = Mat3::Zero();
};

// ANCHOR: piece
Piece piece(const Vec3& r, const Vec3& u, double mu, double s) {
  Piece p;
  const Vec3 x = r - u / s;
  const double slip = std::hypot(x[1], x[2]);
  if (x[0] <= 0) {
    p.F = s * r;
    p.of_r.setIdentity();
  } else if (slip <= mu * x[0]) {
    p.F = u;
    p.of_u.setIdentity();
  } else {
    const Eigen::Vector2d along = x.tail<2>() / slip;
    const Eigen::Matrix2d turn = mu * x[0] / slip * (Eigen::Matrix2d::Identity() - along * along.transpose());
    p.F << u[0], s * (r.tail<2>() - mu * x[0] * along);
    p.of_u(0, 0) = 1;
    p.of_u.block<2, 1>(1, 0) = mu * along;
    p.of_u.block<2, 2>(1, 1) = turn;
    p.of_r.block<2, 1>(1, 0) = -mu * along;
    p.of_r.block<2, 2>(1, 1) = Eigen::Matrix2d::Identity() - turn;
  }
  return p;
}
// ANCHOR_END: piece

// F at r, and J, its derivative with respect to s r: without a unit. Each contact's rows follow its case.
struct Linear {
  VecX F;
  MatX J;
  std::vector<Eigen::Index> open, closed;
};

void linearise(const ConeProblem& problem, const VecX& scale, const VecX& r, Linear& at) {
  at.open.clear();
  at.closed.clear();
  VecX u = problem.b;
  u.noalias() += problem.A * r;
  for (Eigen::Index i = 0; i < problem.contacts(); ++i) {
    const Piece p = piece(r.segment<3>(3 * i), u.segment<3>(3 * i), problem.mu[i], scale[i]);
    at.F.segment<3>(3 * i) = p.F;
    at.J.middleRows<3>(3 * i).noalias() = p.of_u * problem.A.middleRows<3>(3 * i);
    for (Eigen::Index j = 0; j < problem.contacts(); ++j) at.J.block<3, 3>(3 * i, 3 * j) /= scale[j];
    at.J.block<3, 3>(3 * i, 3 * i) += p.of_r;
    for (Eigen::Index row = 3 * i; row < 3 * i + 3; ++row)
      (p.of_u.isZero(0) ? at.open : at.closed).push_back(row);
  }
}

// The smallest change of s r that solves J change = -F in the least-squares sense. Open contacts, whose F is s r, give
// up their impulses; the effect on the others goes to their right-hand side, and only these others are decomposed.
VecX least_change(const Linear& at) {
  VecX change = -at.F;
  if (at.closed.empty()) return change;
  Eigen::CompleteOrthogonalDecomposition<MatX> decomposition;
  decomposition.setThreshold(kRank);
  decomposition.compute(at.J(at.closed, at.closed));
  const VecX right = at.J(at.closed, at.open) * at.F(at.open) - at.F(at.closed);
  const VecX of_closed = decomposition.solve(right);
  change(at.closed) = of_closed;
  return change;
}

}  // namespace

ConeResult solve_newton(const ConeProblem& problem, const SolveOptions& options) {
  ConeResult best;
  if (refused(problem, options, best)) return best;
  const int limit = options.limit > 0 ? options.limit : kSteps;
  const VecX scale = contact_scales(problem);
  VecX r = start_in_cones(problem, options.start);
  Linear at{VecX(r.size()), MatX(r.size(), r.size()), {}, {}};

  judge(problem, r, options.tolerance, Status::limit, best);
  int steps = 0;
  while (best.status != Status::solved && steps < limit) {
    ++steps;
    linearise(problem, scale, r, at);
    VecX change = least_change(at);
    for (Eigen::Index i = 0; i < problem.contacts(); ++i) change.segment<3>(3 * i) /= scale[i];
    if (!change.allFinite()) break;
    r += change;
    ConeResult now;
    judge(problem, start_in_cones(problem, &r), options.tolerance, Status::limit, now);
    if (now.residual < best.residual) best = now;
  }
  best.steps = steps;
  return best;
}

}  // namespace fc::friction

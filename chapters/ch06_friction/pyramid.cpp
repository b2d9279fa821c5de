#include "ch06_friction/pyramid.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "ch03_impulse_lcp/lemke.hpp"
#include "ch06_friction/cone.hpp"
#include "ch06_friction/start.hpp"

namespace fc::friction {
namespace {

constexpr int kMostTurns = 8;
// m/s, relative to max|b|: a slower slip does not turn a pyramid.
constexpr double kSlow = 1e-9;

// The LCP of pyramids whose first sides point along `angle` (n, rad, from tangent 1). Contact i has the rows
// (m+2) i + (0: normal, 1 ... m: sides, m+1: λ).
class Pyramids {
 public:
  Pyramids(const ConeProblem& problem, int sides, const VecX& angle);
  lcp::Lcp lcp() const { return {M_, q_}; }
  VecX impulses(const VecX& z) const { return pushes_ * z; }

 private:
  MatX pushes_;  // 3n by (m+2)n: the impulses r of the unknowns
  MatX M_;
  VecX q_;
};

// ANCHOR: pyramid
Pyramids::Pyramids(const ConeProblem& problem, int sides, const VecX& angle) {
  const Eigen::Index n = problem.contacts(), m = sides, rows = (m + 2) * n;
  pushes_ = MatX::Zero(3 * n, rows);
  for (Eigen::Index i = 0; i < n; ++i) {
    pushes_(3 * i, (m + 2) * i) = 1;
    for (Eigen::Index k = 0; k < m; ++k) {
      const double a = angle[i] + 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(m);
      pushes_.block<2, 1>(3 * i + 1, (m + 2) * i + 1 + k) << std::cos(a), std::sin(a);
    }
  }
  M_ = pushes_.transpose() * problem.A * pushes_;
  q_ = pushes_.transpose() * problem.b;
  const VecX scale = contact_scales(problem);
  for (Eigen::Index i = 0; i < n; ++i) {
    // The unit of λ is free: with this one its row has entries as large as the others of its contact. Being a power of
    // two, it costs no digits.
    const double unit = std::exp2(std::round(0.5 * std::log2(scale[i])));
    const Eigen::Index normal = (m + 2) * i, lambda = normal + m + 1;
    M_(lambda, normal) = unit * problem.mu[i];
    M_.block(lambda, normal + 1, 1, m).setConstant(-unit);
    M_.block(normal + 1, lambda, m, 1).setConstant(unit);
  }
}
// ANCHOR_END: pyramid

// Turns the pyramids of sliding contacts so that a side points against the slip.
void turn(const ConeProblem& problem, const VecX& u, VecX& angle) {
  const double slow = kSlow * problem.b.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < problem.contacts(); ++i) {
    if (u.segment<2>(3 * i + 1).norm() > slow) angle[i] = std::atan2(-u[3 * i + 2], -u[3 * i + 1]);
  }
}

}  // namespace

ConeResult solve_pyramid(const ConeProblem& problem, const SolveOptions& options) {
  ConeResult best;
  if (refused(problem, options, best)) return best;
  const int rounds = !options.turned ? 1 : options.limit > 0 ? options.limit : kMostTurns;
  VecX angle(problem.contacts());
  // The fractional parts of multiples of the golden ratio are spread evenly, in no order.
  for (Eigen::Index i = 0; i < angle.size(); ++i)
    angle[i] = 2 * std::numbers::pi *
               std::fmod(0.6180339887498949 * static_cast<double>(options.draw * (i + 1)), 1.0);
  int pivots = 0;
  for (int round = 0; round < rounds && best.status != Status::solved; ++round) {
    const Pyramids pyramids(problem, options.sides, angle);
    const lcp::LcpResult answer = lcp::solve_lemke(pyramids.lcp());
    pivots += answer.pivots;
    ConeResult now;
    const VecX r = pyramids.impulses(answer.z);
    judge(problem, start_in_cones(problem, &r), options.tolerance, Status::limit, now);
    if (round == 0 || now.residual < best.residual) best = now;
    if (answer.status != Status::solved) break;
    turn(problem, now.u, angle);
  }
  best.pivots = pivots;
  return best;
}

}  // namespace fc::friction

#include "ch03_impulse_lcp/dantzig.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ch03_impulse_lcp/dantzig_solver.hpp"

namespace fc::lcp {
namespace {

// |A_ij - A_ji|, against its row's and column's diagonal, that still counts as symmetric: text files carry
// some ten digits, and the final check is made with A as given. More, and Dantzig's argument (which needs A =
// A') does not hold: `unsuited`.
constexpr double kAsymmetry = 1e-9;
// How often the finished basis is solved afresh and rows that round-off has left violated are driven again.
constexpr int kPasses = 8;

// A Schur complement of nearly zero is either what round-off left of zero or the truth, and taking one for
// the other makes impulses huge or leaves a row violated. No threshold is right for all matrices, but the
// order of the rows decides which nearly dependent rows meet, and a coarser threshold keeps more of them
// apart. So a solve that fails, or whose residual is above kGoodResidual, is done again, in this order, and
// the best result counts.
constexpr std::array<detail::Attempt, 8> kAttempts = {
    {{1, false}, {1, true}, {1e2, false}, {1e2, true}, {1e4, false}, {1e4, true}, {1e6, false}, {1e6, true}}};
constexpr double kGoodResidual = 1e-12;

}  // namespace

namespace detail {

Dantzig::Dantzig(const MatX& A, const VecX& b, const Attempt& attempt, int max_pivots)
    : A_given_(A),
      b_given_(b),
      scale_(b.size()),
      A_(A.rows(), A.cols()),
      b_(b.size()),
      b_size_(b.size() ? b.lpNorm<Eigen::Infinity>() : 0.0),
      rounding_(kRoundingUnits * kEpsilon * std::sqrt(static_cast<double>(b.size() + 16))),
      rank_rounding_(attempt.rank_factor * kRankUnits * kEpsilon * static_cast<double>(b.size() + 4)),
      factor_(A_),
      z_(VecX::Zero(b.size())),
      dz_(b.size()),
      dw_(b.size()),
      basis_dz_(b.size()),
      place_(static_cast<std::size_t>(b.size()), Place::waiting),
      barred_(static_cast<std::size_t>(b.size()), 0),
      max_pivots_(max_pivots),
      reversed_(attempt.reversed) {
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    scale_[i] = A(i, i) > 0 ? std::exp2(std::round(0.5 * std::log2(A(i, i)))) : 1.0;
  }
  for (Eigen::Index j = 0; j < b.size(); ++j) {
    for (Eigen::Index i = 0; i < b.size(); ++i) {
      A_(i, j) = (0.5 * A(i, j) + 0.5 * A(j, i)) / scale_[i] / scale_[j];
    }
  }
  b_ = b.cwiseQuotient(scale_);
  w_ = b_;
  largest_scale_ = b.size() ? scale_.maxCoeff() : 1.0;
}

// Whether A can be positive semidefinite at all, as far as single rows tell.
bool Dantzig::symmetric() const {
  for (Eigen::Index i = 0; i < b_.size(); ++i) {
    if (A_given_(i, i) < 0) return false;
    for (Eigen::Index j = 0; j < b_.size(); ++j) {
      if (A_given_(i, i) == 0 && A_given_(i, j) != 0) return false;
      const double difference = std::abs(A_given_(i, j) - A_given_(j, i));
      if (!(difference / scale_[i] / scale_[j] <= kAsymmetry)) return false;
    }
  }
  return true;
}

// Solves the basis afresh, z_C = -A_CC^-1 b_C, with one step of iterative refinement whose residual is taken
// from the matrix as given in extended precision; so the round-off that pivots have gathered does not reach
// the answer.
void Dantzig::solve_basis() {
  const int k = factor_.size();
  VecX correction(k);
  z_.setZero();
  w_ = b_;
  for (int round = 0; round < 2; ++round) {
    for (int p = 0; p < k; ++p) correction[p] = -w_[factor_.row(p)];
    factor_.solve(correction);
    for (int p = 0; p < k; ++p) z_[factor_.row(p)] += correction[p];
    w_ = evaluate(A_given_, b_given_, z_.cwiseQuotient(scale_)).cwiseQuotient(scale_);
  }
}

// Takes the row with the most negative z out of the basis, if there is one beyond round-off.
bool Dantzig::drop_negative() {
  const double allowed = z_tolerance();
  int worst = -1;
  double most = 0;
  for (int p = 0; p < factor_.size(); ++p) {
    const int i = factor_.row(p);
    if (z_[i] < -allowed && z_[i] < most) {
      most = z_[i];
      worst = p;
    }
  }
  if (worst < 0) return false;
  leave(worst);
  return true;
}

LcpResult Dantzig::finish(Status status) {
  // An impulse that is only round-off is none: removing it changes no velocity by more than round-off.
  const double nothing = z_tolerance();
  for (double& z : z_) z = z > nothing ? z : 0.0;
  LcpResult result;
  result.z = z_.cwiseQuotient(scale_);
  result.w = evaluate(A_given_, b_given_, result.z);
  if (!result.z.allFinite() ||
      !result.w.allFinite()) {  // an overflow: numbers near 1e300, or a hopeless matrix
    status = status == Status::solved ? Status::limit : status;
    result.z.setZero();
    result.w = b_given_;
  }
  result.residual = residual({A_given_, b_given_}, result.z, result.w);
  result.pivots = pivots_;
  result.status = status;
  if (status == Status::solved && !acceptable({A_given_, b_given_}, result.z, result.w)) {
    result.status = lowest_schur_ < -rank_rounding_ ? Status::unsuited : Status::limit;
  }
  return result;
}

LcpResult Dantzig::run() {
  if (!symmetric()) return finish(Status::unsuited);
  if (!A_.allFinite() || !b_.allFinite()) return finish(Status::limit);  // too far apart for our numbers
  const int n = static_cast<int>(b_.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    bool changed = false;
    for (int k = 0; k < n; ++k) {
      const int d = reversed_ ? n - 1 - k : k;
      if (place_[static_cast<std::size_t>(d)] == Place::basis) continue;
      if (pass > 0 && w_[d] >= -w_tolerance(d)) continue;
      changed = true;
      switch (drive(d)) {
        case Drive::done:
          break;
        case Drive::no_solution:
          return finish(Status::no_solution);
        case Drive::limit:
          return finish(Status::limit);
        case Drive::unsuited:
          return finish(Status::unsuited);
      }
    }
    if (!changed) break;
    do {
      solve_basis();
    } while (drop_negative());
  }
  return finish(Status::solved);
}

}  // namespace detail

LcpResult solve_dantzig(const Lcp& problem, const DantzigOptions& options) {
  check_arguments(problem);
  const MatX& A = problem.A;
  const VecX& b = problem.b;
  int pivots_left = options.max_pivots > 0 ? options.max_pivots : 100 + 50 * static_cast<int>(b.size());
  LcpResult best;
  int pivots = 0;
  for (const detail::Attempt& attempt : kAttempts) {
    LcpResult result = detail::Dantzig(A, b, attempt, pivots_left).run();
    const bool first = &attempt == &kAttempts.front();
    const bool hopeless = result.status == Status::unsuited && result.pivots == 0;  // not symmetric
    pivots += result.pivots;
    pivots_left -= result.pivots;
    const bool better = best.status != Status::solved || result.residual < best.residual;
    if (first || (result.status == Status::solved && better)) best = std::move(result);
    if (best.status == Status::solved && best.residual <= kGoodResidual) break;
    if (best.status == Status::no_solution || hopeless || pivots_left <= 0) break;
  }
  best.pivots = pivots;
  return best;
}

}  // namespace fc::lcp

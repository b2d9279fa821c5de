// How one row is driven to w >= 0: direction, ratio test, exchange.
#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/dantzig_solver.hpp"

namespace fc::lcp::detail {
namespace {

// A Schur complement below minus this proves an eigenvalue below zero that no round-off explains: `unsuited`
// if the row cannot be driven without it.
constexpr double kIndefinite = 1e-6;
// A certificate y, |y|_1 = 1, of infeasibility counts if (A y)_i <= kCertificateSlack for all i and b'y is
// below -kCertificateGap |b|'y. Smaller gaps may be round-off in b (a ball held between two walls); they are
// left to acceptable().
constexpr double kCertificateSlack = 1e-10;
constexpr double kCertificateGap = 1e-9;

}  // namespace

// The direction that raises z_d by 1 and keeps w = 0 in the basis: A_CC dz_C = -A_Cd; and what it does to w.
void Dantzig::set_direction(int d) {
  const int k = factor_.size();
  for (int p = 0; p < k; ++p) basis_dz_[p] = -A_(factor_.row(p), d);
  factor_.solve(basis_dz_.head(k));
  dz_.setZero();
  dz_[d] = 1;
  dw_ = A_.col(d);
  for (int p = 0; p < k; ++p) {
    dz_[factor_.row(p)] = basis_dz_[p];
    dw_.noalias() += basis_dz_[p] * A_.col(factor_.row(p));
  }
  for (const int i : factor_.rows()) dw_[i] = 0;  // by construction; what is left is round-off
}

// The row that stops the drive of d first. Ratio test in two passes (Harris 1973): the shortest step with
// every bound relaxed by round-off, then, among the rows that stop within it, d itself (on a tie it must
// enter the basis, or a solvable singular problem looks unsolvable), or else the row with the steepest slope,
// whose exchange is the best conditioned. Many zero steps in a row could be a cycle of ties: then the
// smallest index decides, which cannot cycle (Chang 1979).
Dantzig::Blocking Dantzig::blocking_row(int d, double schur) {
  const double slope_rounding = rounding_ * dz_.lpNorm<1>();
  const double z_rounding = z_tolerance();
  const bool careful = zero_steps_ > static_cast<int>(b_.size()) + 4;

  const auto each_candidate = [&](auto&& visit) {
    for (int p = 0; p < factor_.size(); ++p) {
      const int i = factor_.row(p);
      if (dz_[i] < -slope_rounding) visit(i, p, std::max(0.0, z_[i]), -dz_[i], z_rounding);
    }
    for (int i = 0; i < static_cast<int>(b_.size()); ++i) {
      const auto u = static_cast<std::size_t>(i);
      if (i == d || place_[u] != Place::outside || barred_[u]) continue;
      if (dw_[i] < -slope_rounding) visit(i, -1, std::max(0.0, w_[i]), -dw_[i], w_tolerance(i));
    }
  };

  double longest = kInfinity;
  each_candidate([&](int, int, double value, double slope, double slack) {
    longest = std::min(longest, (value + (careful ? 0.0 : slack)) / slope);
  });
  const double own_step = schur > rank_rounding_ ? std::max(0.0, -w_[d] / schur) : kInfinity;
  if (own_step <= longest && own_step < kInfinity) return {d, -1, own_step};

  Blocking best;
  double best_slope = 0;
  each_candidate([&](int i, int p, double value, double slope, double) {
    if (value / slope > longest) return;
    if (careful ? (best.row < 0 || i < best.row) : slope > best_slope) {
      best = {i, p, value / slope};
      best_slope = slope;
    }
  });
  return best;
}

void Dantzig::advance(int d, double step) {
  zero_steps_ = step * std::abs(dw_[d]) > w_tolerance(d) ? 0 : zero_steps_ + 1;
  z_ += step * dz_;
  w_ += step * dw_;
}

void Dantzig::enter(int i) {
  factor_.enter();
  place_[static_cast<std::size_t>(i)] = Place::basis;
  w_[i] = 0;
  ++pivots_;
}

void Dantzig::leave(int position) {
  const int i = factor_.row(position);
  factor_.leave(position);
  place_[static_cast<std::size_t>(i)] = Place::outside;
  z_[i] = 0;
  ++pivots_;
}

// Whether the direction, along which nothing stops row d, proves that no solution exists: y = dz >= 0 with
// A'y <= 0 and b'y < 0 contradicts w >= 0, since y'w = (A'y)'z + y'b < 0 for every z >= 0. Checked against
// the matrix as given.
bool Dantzig::proves_infeasible(int d) const {
  VecX y = dz_.cwiseMax(0.0);
  y[d] = 1;
  y /= y.lpNorm<1>();
  const VecX y_given = y.cwiseQuotient(scale_);
  const VecX Ay = (A_given_.transpose() * y_given).cwiseQuotient(scale_);
  const double gap = b_given_.dot(y_given);
  return Ay.maxCoeff() <= kCertificateSlack && gap < -kCertificateGap * b_given_.cwiseAbs().dot(y_given);
}

// Row d has reached w_d = 0 to within round-off without being the one that blocked: puts it where it belongs.
// If it depends on the basis, the impulse is moved along the null direction, which changes no velocity, until
// d or a row of the basis has none left. False if that is impossible.
void Dantzig::settle(int d) {
  place_[static_cast<std::size_t>(d)] = Place::outside;
  if (z_[d] <= 0) {
    z_[d] = 0;
    return;
  }
  if (factor_.schur(d) > rank_rounding_) {
    enter(d);
    return;
  }
  set_direction(d);
  double step = z_[d];
  int position = -1;
  for (int p = 0; p < factor_.size(); ++p) {
    const int i = factor_.row(p);
    if (dz_[i] > rounding_ * dz_.lpNorm<1>() && z_[i] / dz_[i] < step) {
      step = std::max(0.0, z_[i] / dz_[i]);
      position = p;
    }
  }
  z_ -= step * dz_;
  w_ -= step * dw_;
  if (position < 0) {
    z_[d] = 0;
    return;
  }
  leave(position);
  if (factor_.schur(d) > rank_rounding_) {
    enter(d);
  } else {
    z_[d] = 0;
  }
}

// Raises z_d until w_d >= 0, keeping every row that is done complementary.
// ANCHOR: drive
Drive Dantzig::drive(int d) {
  std::fill(barred_.begin(), barred_.end(), 0);
  zero_steps_ = 0;
  while (w_[d] < -w_tolerance(d)) {
    if (pivots_ >= max_pivots_) return Drive::limit;
    const double schur = factor_.schur(d);
    lowest_schur_ = std::min(lowest_schur_, schur);
    set_direction(d);
    const Blocking blocking = blocking_row(d, schur);
    if (blocking.row < 0) {
      if (proves_infeasible(d)) return Drive::no_solution;
      // Either A has a negative eigenvalue, or b leaves the range of A by a little more than round-off.
      if (schur < -kIndefinite) return Drive::unsuited;
      settle(d);
      return Drive::done;
    }
    if (blocking.row == d) {
      advance(d, blocking.step);
      enter(d);
      return Drive::done;
    }
    if (blocking.position < 0) {
      // In exact arithmetic a row that blocks never depends on the basis. In ours it may: then its w is
      // falling by round-off only, and it is left to the next pass.
      if (factor_.schur(blocking.row) <= rank_rounding_) {
        barred_[static_cast<std::size_t>(blocking.row)] = 1;
        continue;
      }
      advance(d, blocking.step);
      factor_.schur(blocking.row);
      enter(blocking.row);
    } else {
      advance(d, blocking.step);
      leave(blocking.position);
    }
  }
  settle(d);
  return Drive::done;
}
// ANCHOR_END: drive

}  // namespace fc::lcp::detail

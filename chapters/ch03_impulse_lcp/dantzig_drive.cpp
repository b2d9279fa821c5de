// How one row is driven to where its w allows it to stay: direction, ratio test, exchange.
#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/dantzig_core.hpp"

namespace fc::lcp::detail {
namespace {

// A Schur complement below minus this proves a negative eigenvalue that no round-off explains: `unsuited`, if
// nothing stops that row's drive.
constexpr double kIndefinite = 1e-6;

}  // namespace

// The direction that changes z_d by `sign` and keeps w = 0 in the basis: A_CC dz_C = -sign A_Cd; and what it
// does to the w of the rows at a bound. Follows factor_.schur(d).
template <class Real>
void DantzigCore<Real>::set_direction(int d, Real sign) {
  const int k = factor_.size();
  factor_.candidate_column(basis_.data());
  extent(dz_).setZero();
  dz_[d] = sign;
  dz_sum_ = 1;
  for (int p = 0; p < k; ++p) {
    dz_[factor_.row(p)] = -sign * basis_[p];
    dz_sum_ += std::abs(basis_[p]);
  }
  extent(dw_).setZero();
  outside_.clear();
  for (int i = first_; i < first_ + extent_; ++i) {
    if (i != d && (place(i) == Place::at_lower || place(i) == Place::at_upper)) outside_.push_back(i);
  }
  // By rows or by columns, whichever is fewer.
  if (static_cast<int>(outside_.size()) <= k) {
    const Matrix& rows = symmetric_ ? A_ : transposed_;
    for (const int i : outside_) dw_[i] = rows.col(i).segment(first_, extent_).dot(extent(dz_));
  } else {
    extent(dw_) = sign * A_.col(d).segment(first_, extent_);
    for (int p = 0; p < k; ++p)
      extent(dw_) -= (sign * basis_[p]) * A_.col(factor_.row(p)).segment(first_, extent_);
    for (const int i : factor_.rows()) dw_[i] = 0;  // by construction; what is left is round-off
  }
}

// For each row that the direction moves towards a place where it must be exchanged, calls visit(row, position
// in the basis or -1, distance to that place, speed, slack of the distance).
template <class Real>
template <class Visit>
void DantzigCore<Real>::each_candidate(Visit&& visit) const {
  const Real slope_rounding = rounding_ * dz_sum_, z_rounding = z_tolerance();
  for (int p = 0; p < factor_.size(); ++p) {
    const int i = factor_.row(p);
    if (dz_[i] < -slope_rounding && lower_[i] > -kInfinity)
      visit(i, p, z_[i] - lower_[i], -dz_[i], z_rounding);
    if (dz_[i] > slope_rounding && upper_[i] < kInfinity) visit(i, p, upper_[i] - z_[i], dz_[i], z_rounding);
  }
  for (const int i : outside_) {
    if (barred_[static_cast<std::size_t>(i)]) continue;
    const Real side = place(i) == Place::at_lower ? 1 : -1;
    if (side * dw_[i] < -slope_rounding) visit(i, -1, side * w_[i], -side * dw_[i], w_tolerance(i));
  }
}

// The row that stops the drive of d first. A ratio test in two passes (Harris 1973): first the shortest step
// with every bound relaxed by round-off; then, among the rows that stop within it, d itself (on a tie it must
// enter the basis, or a solvable singular problem looks unsolvable), or else the row with the steepest slope,
// whose exchange is the best conditioned. Many successive zero steps could be a cycle of ties: then the
// smallest index decides, which cannot cycle (Chang 1979).
template <class Real>
typename DantzigCore<Real>::Blocking DantzigCore<Real>::blocking_row(int d, Real schur) {
  const bool careful = zero_steps_ > n_ + 4;
  Real longest = kInfinity;
  each_candidate([&](int, int, Real distance, Real speed, Real slack) {
    longest = std::min(longest, (std::max<Real>(0, distance) + (careful ? 0 : slack)) / speed);
  });
  const Real to_zero = schur > rank_rounding_ ? std::abs(w_[d]) / schur : kInfinity;
  const Real to_bound = dz_[d] > 0 ? upper_[d] - z_[d] : z_[d] - lower_[d];
  if (to_zero <= longest && to_zero <= to_bound && to_zero < kInfinity) return {d, -1, to_zero, false};
  if (to_bound <= longest && to_bound < kInfinity) return {d, -1, to_bound, true};

  Blocking best;
  Real best_speed = 0;
  each_candidate([&](int i, int p, Real distance, Real speed, Real) {
    const Real step = std::max<Real>(0, distance) / speed;
    if (step > longest) return;
    if (careful ? (best.row < 0 || i < best.row) : speed > best_speed) {
      best = {i, p, step, false};
      best_speed = speed;
    }
  });
  return best;
}

template <class Real>
void DantzigCore<Real>::advance(int d, Real step) {
  zero_steps_ = step * std::abs(dw_[d]) > w_tolerance(d) ? 0 : zero_steps_ + 1;
  extent(z_) += step * extent(dz_);
  extent(w_) += step * extent(dw_);
  z_sum_ = extent(z_).cwiseAbs().sum();
}

template <class Real>
void DantzigCore<Real>::enter(int i) {
  factor_.enter();
  place(i) = Place::basis;
  w_[i] = 0;
  ++pivots_;
}

template <class Real>
void DantzigCore<Real>::leave(int position, bool upper) {
  const int i = factor_.row(position);
  factor_.leave(position);
  place(i) = upper ? Place::at_upper : Place::at_lower;
  z_[i] = upper ? upper_[i] : lower_[i];
  ++pivots_;
}

// Whether the direction, along which nothing stops row d, proves that no solution exists.
template <class Real>
bool DantzigCore<Real>::proves_infeasible(int d) {
  VecX y = VecX::Zero(n_);
  for (int i = first_; i < first_ + extent_; ++i) y[i] = static_cast<double>(dz_[i] * inverse_scale_[i]);
  y[d] = static_cast<double>(dz_[d] * inverse_scale_[d]);
  certificate_ = no_solution_certificate(*problem_, y);
  return certificate_.size() > 0;
}

// Row d has reached w_d = 0 to within round-off, but another row blocked the drive: gives d its place. If it
// depends on the basis, the impulse is moved along the null direction, which changes no velocity, until d or
// a row of the basis is at a bound.
template <class Real>
void DantzigCore<Real>::settle(int d) {
  place(d) = Place::waiting;
  if (z_[d] <= lower_[d] || z_[d] >= upper_[d]) {
    place(d) = z_[d] <= lower_[d] ? Place::at_lower : Place::at_upper;
    z_[d] = place(d) == Place::at_lower ? lower_[d] : upper_[d];
    return;
  }
  const Real schur = factor_.schur(d);
  if (schur > rank_rounding_) {
    enter(d);
    return;
  }
  const bool down = lower_[d] > -kInfinity;
  if (!down && upper_[d] == kInfinity) return;  // no bound to go to: its w stays 0 as long as the basis does
  set_direction(d, down ? -1 : 1);
  Real step = down ? z_[d] - lower_[d] : upper_[d] - z_[d];
  int position = -1;
  for (int p = 0; p < factor_.size(); ++p) {
    const int i = factor_.row(p);
    if (std::abs(dz_[i]) <= rounding_ * dz_sum_) continue;
    const Real room = std::max<Real>(0, dz_[i] < 0 ? z_[i] - lower_[i] : upper_[i] - z_[i]);
    if (room < step * std::abs(dz_[i])) {
      step = room / std::abs(dz_[i]);
      position = p;
    }
  }
  advance(d, step);
  if (position >= 0) {
    leave(position, dz_[factor_.row(position)] > 0);
    if (factor_.schur(d) > rank_rounding_) {
      enter(d);
      return;
    }
  }
  z_[d] = down ? lower_[d] : upper_[d];
  place(d) = down ? Place::at_lower : Place::at_upper;
}

// Changes z_d until w_d allows it to stay, keeping every row that is done complementary.
// ANCHOR: drive
template <class Real>
Drive DantzigCore<Real>::drive(int d) {
  std::fill(barred_.begin(), barred_.end(), 0);
  zero_steps_ = 0;
  while (violated(d)) {
    if (pivots_ >= max_pivots_) return Drive::limit;
    const Real schur = factor_.schur(d);
    lowest_schur_ = std::min(lowest_schur_, schur);
    set_direction(d, w_[d] < 0 ? 1 : -1);
    dw_[d] = dz_[d] * schur;
    const Blocking blocking = blocking_row(d, schur);
    if (blocking.row < 0) {
      if (proves_infeasible(d)) return Drive::no_solution;
      // Either A has a negative eigenvalue, or b leaves the range of A by a little more than round-off.
      if (schur < -kIndefinite || !symmetric_) return Drive::unsuited;
      settle(d);
      return Drive::done;
    }
    if (blocking.row == d) {
      advance(d, blocking.step);
      if (blocking.at_bound) {
        z_[d] = dz_[d] > 0 ? upper_[d] : lower_[d];
        break;
      }
      enter(d);
      return Drive::done;
    }
    if (blocking.position < 0) {
      // In exact arithmetic a blocking row never depends on the basis. In floating point it may: then its w
      // falls by round-off only, and it is left to the next pass.
      if (factor_.schur(blocking.row) <= rank_rounding_) {
        barred_[static_cast<std::size_t>(blocking.row)] = 1;
        continue;
      }
      advance(d, blocking.step);
      enter(blocking.row);
    } else {
      advance(d, blocking.step);
      leave(blocking.position, dz_[blocking.row] > 0);
    }
  }
  settle(d);
  return Drive::done;
}
// ANCHOR_END: drive

template class DantzigCore<double>;
template class DantzigCore<long double>;

}  // namespace fc::lcp::detail

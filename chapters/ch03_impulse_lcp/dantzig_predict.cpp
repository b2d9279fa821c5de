// A basis predicted as a whole: where Dantzig's method begins if there is a guess, or if there are many rows.
#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/dantzig_core.hpp"

namespace fc::lcp::detail {
namespace {

// How many exchanges of all violated rows at once may fail to reduce their number before the method goes on
// row by row.
constexpr int kPatience = 3;
// Exchanging rows one by one is cheaper than a new factorisation for fewer than 1 / kShare of the basis.
constexpr int kShare = 6;
// If the rows that depend on the basis are more than 1 / kRedundant of it, the drives have to find which of
// them push: exchanged together, they only take turns.
constexpr int kRedundant = 4;

}  // namespace

// Block principal pivoting (Kostreva 1978; Júdice and Pires 1994): factor the guessed basis, find z and w,
// and exchange every row that is violated, as long as they become fewer. It need not end, and proves nothing.
// But its result, less the rows whose z is out of bounds, is a state that Dantzig's method could have
// reached: the basis has w = 0 and z within the bounds; other rows are done if w allows it, and else wait.
template <class Real>
void DantzigCore<Real>::predict() {
  first_ = 0;
  extent_ = n_;
  int dropped = factor_basis();
  int fewest = n_ + 1, patience = kPatience;
  while (true) {
    solve_basis();
    const int count = violations();
    patience = count < fewest ? kPatience : patience - 1;
    fewest = std::min(fewest, count);
    const bool redundant = dropped * kRedundant > factor_.size();
    if (count == 0 || patience == 0 || redundant || pivots_ + count > max_pivots_) break;
    if (count * kShare < factor_.size()) {
      exchange_violated();
    } else {
      pivots_ += count;
      replace_violated();
      dropped = factor_basis();
    }
  }
  drop_violated();
  for (int i = 0; i < n_; ++i) {
    if (place(i) != Place::basis && violated(i)) place(i) = Place::waiting;
  }
}

// Factors the rows that are to be in the basis, and sets each z to its bound, the basis's to 0. Rows that
// depend on others wait; returns their number.
template <class Real>
int DantzigCore<Real>::factor_basis() {
  wanted_.clear();
  for (int i = 0; i < n_; ++i) {
    if (place(i) == Place::basis) {
      wanted_.push_back(i);
      place(i) = Place::waiting;
    }
    z_[i] = place(i) == Place::at_lower ? lower_[i] : place(i) == Place::at_upper ? upper_[i] : Real(0);
  }
  factor_.factor(wanted_, rank_rounding_);
  for (const int i : factor_.rows()) place(i) = Place::basis;
  return static_cast<int>(wanted_.size()) - factor_.size();
}

// Sets the places of all rows, from a guess of z, or from w at z = 0. False, and no places, if that takes
// more exchanges than the limit allows.
template <class Real>
bool DantzigCore<Real>::guess(const VecX* start) {
  for (int i = 0; i < n_; ++i) {
    if (start != nullptr) {
      const Real z = (*start)[i] * scale_[i];
      place(i) = z <= lower_[i] ? Place::at_lower : z >= upper_[i] ? Place::at_upper : Place::basis;
    } else {
      const bool pushed = (b_[i] < 0 && upper_[i] > 0) || (b_[i] > 0 && lower_[i] < 0);
      place(i) = pushed           ? Place::basis
                 : lower_[i] == 0 ? Place::at_lower
                 : upper_[i] == 0 ? Place::at_upper
                                  : Place::waiting;
    }
    pivots_ += place(i) == Place::basis ? 1 : 0;
  }
  if (pivots_ <= max_pivots_) return true;
  pivots_ = 0;
  place_.assign(static_cast<std::size_t>(n_), Place::waiting);
  return false;
}

// How many rows are violated in their present places.
template <class Real>
int DantzigCore<Real>::violations() const {
  const Real slack = z_tolerance();
  int count = 0;
  for (int i = 0; i < n_; ++i) count += place(i) == Place::basis ? !within_bounds(i, slack) : violated(i);
  return count;
}

// Moves every violated row to its other place, for factor_basis().
template <class Real>
void DantzigCore<Real>::replace_violated() {
  const Real slack = z_tolerance();
  for (int i = 0; i < n_; ++i) {
    if (place(i) != Place::basis) {
      if (violated(i)) place(i) = Place::basis;
    } else if (!within_bounds(i, slack)) {
      place(i) = z_[i] < lower_[i] ? Place::at_lower : Place::at_upper;
    }
  }
}

// The same by updates of the factor.
template <class Real>
void DantzigCore<Real>::exchange_violated() {
  const Real slack = z_tolerance();
  wanted_.clear();
  for (int i = 0; i < n_; ++i) {
    if (place(i) != Place::basis && violated(i)) wanted_.push_back(i);
  }
  for (int p = factor_.size() - 1; p >= 0; --p) {
    const int i = factor_.row(p);
    if (!within_bounds(i, slack)) leave(p, z_[i] > upper_[i]);
  }
  for (const int i : wanted_) {
    if (factor_.schur(i) > rank_rounding_) {
      enter(i);
    } else {
      place(i) = Place::waiting;
    }
  }
}

// Removes rows whose z is out of its bounds from the basis, until there are none.
template <class Real>
void DantzigCore<Real>::drop_violated() {
  while (true) {
    const Real slack = z_tolerance();
    bool dropped = false;
    for (int p = factor_.size() - 1; p >= 0; --p) {
      const int i = factor_.row(p);
      if (within_bounds(i, slack)) continue;
      leave(p, z_[i] > upper_[i]);
      dropped = true;
    }
    if (!dropped) return;
    solve_basis();
  }
}

template class DantzigCore<double>;
template class DantzigCore<long double>;

}  // namespace fc::lcp::detail

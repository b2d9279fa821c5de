#include "ch03_impulse_lcp/dantzig_core.hpp"

#include <algorithm>
#include <cmath>

namespace fc::lcp::detail {
namespace {

// |A_ij - A_ji|, relative to the two diagonal entries, that still counts as symmetric: text files carry about
// ten digits, and the final check uses A as given.
constexpr double kAsymmetry = 1e-9;
// How often the finished basis is solved again, and rows that round-off has left violated are driven again.
constexpr int kPasses = 8;
// From this many rows on a basis is predicted even without a guess: fewer are done faster one by one.
constexpr int kPredictFrom = 20;
// Rows and columns of a block in which A and A' are read together.
constexpr int kBlock = 16;

// The power of two s with x / s^2 in [1/2, 2), by x's exponent alone; x > 0.
double root_of_two(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, exponent >> 1);
}

}  // namespace

template <class Real>
void DantzigCore<Real>::reserve(int n) {
  if (n <= capacity_) return;
  // Columns a multiple of 4096 bytes apart would compete for the same place in the cache.
  capacity_ = n % 64 == 0 ? n + 8 : n;
  for (Vector* v : {&scale_, &inverse_scale_, &b_, &lower_, &upper_, &z_, &w_, &dz_, &dw_, &basis_})
    v->resize(capacity_);
  A_.resize(capacity_, capacity_);
  for (auto* v : {&outside_, &wanted_}) v->reserve(static_cast<std::size_t>(capacity_));
}

template <class Real>
bool DantzigCore<Real>::load(const Lcp& problem) {
  problem_ = &problem;
  n_ = static_cast<int>(problem.size());
  reserve(n_);
  b_size_ = 0;
  largest_scale_ = n_ == 0 ? 1 : 0;
  for (int i = 0; i < n_; ++i) {
    const double a = problem.A(i, i);
    const double scale = a > 0 ? root_of_two(a) : 1.0;
    scale_[i] = scale;
    inverse_scale_[i] = 1 / scale;
    b_[i] = problem.b[i] * inverse_scale_[i];
    lower_[i] = problem.low(i) * scale;
    upper_[i] = problem.high(i) * scale;
    b_size_ = std::max<Real>(b_size_, std::abs(problem.b[i]));
    largest_scale_ = std::max(largest_scale_, scale_[i]);
  }
  return load_matrix();
}

// A, scaled; its symmetric part where it is symmetric but for round-off.
template <class Real>
bool DantzigCore<Real>::load_matrix() {
  const MatX& A = problem_->A;
  for (int j = 0; j < n_; ++j) {
    const double* const from = A.data() + static_cast<Eigen::Index>(j) * n_;
    Real* const to = A_.data() + static_cast<Eigen::Index>(j) * A_.outerStride();
    const Real column_scale = inverse_scale_[j];
    const Real* const row_scale = inverse_scale_.data();
    for (int i = 0; i < n_; ++i) to[i] = from[i] * (row_scale[i] * column_scale);
  }
  symmetric_ = true;
  for (int J = 0; J < n_; J += kBlock) {
    for (int I = 0; I <= J; I += kBlock) {
      const int rows = std::min(kBlock, n_ - I), columns = std::min(kBlock, n_ - J);
      int different = 0;
      for (int j = J; j < J + columns; ++j) {
        for (int i = I; i < I + rows; ++i) different += A_(i, j) != A_(j, i);
      }
      if (different > 0) symmetrise(I, rows, J, columns);
    }
  }
  if (!symmetric_) {
    if (transposed_.rows() < capacity_) transposed_.resize(capacity_, capacity_);
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i)
        transposed_(j, i) = A_(i, j) = A(i, j) * inverse_scale_[i] * inverse_scale_[j];
    }
  }
  for (int i = 0; i < n_; ++i) {
    if (A(i, i) > 0) continue;
    if (A(i, i) < 0 || !A_.col(i).head(n_).isZero(0) || !A_.row(i).head(n_).isZero(0)) return false;
  }
  return true;
}

template <class Real>
void DantzigCore<Real>::symmetrise(int first_row, int rows, int first_column, int columns) {
  for (int j = first_column; j < first_column + columns; ++j) {
    for (int i = first_row; i < std::min(first_row + rows, j); ++i) {
      if (!(std::abs(A_(i, j) - A_(j, i)) <= kAsymmetry)) symmetric_ = false;  // also an overflow
      A_(i, j) = A_(j, i) = (A_(i, j) + A_(j, i)) / 2;
    }
  }
}

template <class Real>
Real DantzigCore<Real>::w_of(int i) const {
  const Matrix& rows = symmetric_ ? A_ : transposed_;
  return b_[i] + rows.col(i).segment(first_, extent_).dot(z_.segment(first_, extent_));
}

// w = A z + b for all rows, in Real.
template <class Real>
void DantzigCore<Real>::set_w() {
  w_.head(n_) = b_.head(n_);
  z_sum_ = 0;
  for (int j = 0; j < n_; ++j) {
    if (z_[j] == 0) continue;
    w_.head(n_) += z_[j] * A_.col(j).head(n_);
    z_sum_ += std::abs(z_[j]);
  }
}

// Removes what round-off has left in the basis's w, so that its z are as good as after a new solve.
template <class Real>
void DantzigCore<Real>::solve_basis() {
  first_ = 0;
  extent_ = n_;
  pivots_solved_ = pivots_;
  set_w();
  const int k = factor_.size();
  for (int p = 0; p < k; ++p) basis_[p] = w_[factor_.row(p)];
  factor_.solve(basis_.data());
  for (int p = 0; p < k; ++p) z_[factor_.row(p)] -= basis_[p];
  set_w();
}

template <class Real>
void DantzigCore<Real>::impulses(VecX& z) const {
  // An impulse that is only round-off is set to zero: that changes no velocity by more than round-off.
  const Real nothing = z_tolerance();
  z.resize(n_);
  for (int i = 0; i < n_; ++i) {
    const Real near = z_[i] <= lower_[i] + nothing   ? lower_[i]
                      : z_[i] >= upper_[i] - nothing ? upper_[i]
                                                     : z_[i];
    z[i] = static_cast<double>(near * inverse_scale_[i]);
  }
}

template <class Real>
bool DantzigCore<Real>::refine() {
  VecX z(n_);
  for (int i = 0; i < n_; ++i) z[i] = static_cast<double>(z_[i] * inverse_scale_[i]);
  const VecX w = evaluate(problem_->A, problem_->b, z);
  const int k = factor_.size();
  for (int p = 0; p < k; ++p) basis_[p] = w[factor_.row(p)] * inverse_scale_[factor_.row(p)];
  factor_.solve(basis_.data());
  bool inside = true;
  for (int p = 0; p < k; ++p) {
    const int i = factor_.row(p);
    z_[i] = z[i] * scale_[i] - basis_[p];
    inside = inside && within_bounds(i, z_tolerance());
  }
  return inside;
}

template <class Real>
Status DantzigCore<Real>::solve(const Attempt& attempt, const VecX* start, int max_pivots) {
  const double n = n_;
  rounding_ = static_cast<Real>(kRoundingUnits * std::sqrt(n + 16)) * kEpsilon;
  rank_rounding_ = static_cast<Real>(attempt.rank_factor * kRankUnits * (n + 4)) * kEpsilon;
  pivots_ = pivots_solved_ = 0;
  max_pivots_ = max_pivots;
  lowest_schur_ = 0;
  z_sum_ = 0;
  z_.head(n_).setZero();
  place_.assign(static_cast<std::size_t>(n_), Place::waiting);
  barred_.assign(static_cast<std::size_t>(n_), 0);
  factor_.reset(A_, symmetric_ ? A_ : transposed_, n_);
  first_ = attempt.reversed ? n_ : 0;
  extent_ = 0;

  const bool may_guess = start != nullptr || (attempt.predict && n_ >= kPredictFrom);
  if (may_guess && guess(start)) predict();
  bool changed = false;
  return drive_rows(attempt.reversed, changed);
}

// Drives every row that is not where its w allows it to stay.
template <class Real>
Status DantzigCore<Real>::drive_rows(bool reversed, bool& changed) {
  for (int k = 0; k < n_; ++k) {
    const int d = reversed ? n_ - 1 - k : k;
    if (place(d) == Place::basis) continue;
    if (place(d) == Place::waiting) {
      if (extent_ < n_) {  // the drives reach it for the first time
        ++extent_;
        if (reversed) --first_;
      }
      w_[d] = w_of(d);
    }
    if (violated(d)) {
      changed = true;
    } else if (place(d) != Place::waiting) {
      continue;
    }
    switch (drive(d)) {
      case Drive::done:
        break;
      case Drive::no_solution:
        return Status::no_solution;
      case Drive::limit:
        return Status::limit;
      case Drive::unsuited:
        return Status::unsuited;
    }
  }
  return Status::solved;
}

template <class Real>
Status DantzigCore<Real>::improve() {
  bool changed = true;
  for (int pass = 0; changed && pass < kPasses; ++pass) {
    solve_basis();
    drop_violated();
    changed = false;
    const Status status = drive_rows(false, changed);
    if (status != Status::solved) return status;
  }
  return Status::solved;
}

template class DantzigCore<double>;
template class DantzigCore<long double>;

}  // namespace fc::lcp::detail

#include "ch03_impulse_lcp/lemke.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ch03_impulse_lcp/active_set.hpp"

namespace fc::lcp {
namespace {

// Rows and b are scaled so that entries are about 1. An entry of the entering column below kEntry (times the
// column's largest) does not block; two ratios that differ by less than kTie (times the larger, or
// absolutely) are equal.
constexpr double kEntry = 1e-9;
// Where nothing blocks, entries down to this one may block, before a ray is accepted: smaller ones are
// round-off.
constexpr double kLeastEntry = 1e-14;
constexpr double kTie = 1e-11;
// How often the inverse is compared with the matrix, and from which error on it is computed again.
constexpr int kLookEvery = 16;
constexpr double kDrift = 1e-11;
// c is (1, ..., 1); if round-off, or a ray that proves nothing, ends the path from there, c is slanted by
// these amounts.
constexpr std::array<double, 3> kSlants = {0, 1, 7};

class Lemke {
 public:
  Lemke(const Lcp& problem, double slant);
  Status run(int limit);
  int pivots() const { return pivots_; }
  // z in the problem's unit, and the rows that are in the basis with it.
  VecX impulses() const;
  std::vector<int> active() const;
  // The direction of z along the ray on which run() ended.
  VecX ray() const;

 private:
  // Unknowns by number: w_i is i, z_i is n + i, z_0 is 2 n.
  int complement(int unknown) const { return unknown < n_ ? unknown + n_ : unknown - n_; }
  void set_column(int unknown);
  int leaving_row(double least) const;
  bool before(int i, int j) const;
  void exchange(int row, int entering);
  MatX basis_matrix() const;
  void refresh_if_drifted();

  const Lcp& problem_;
  int n_;
  VecX scale_;
  double size_ = 1;  // of b: what z and w are divided by
  MatX A_;
  VecX b_;
  MatX inverse_;            // B^-1, B the columns of the basic unknowns in w - A z - c z_0 = b
  VecX values_;             // B^-1 b: the basic unknowns, in the order of basis_
  VecX column_;             // B^-1 times the entering column
  VecX cover_;              // c, in scaled rows
  std::vector<int> basis_;  // the unknown of each row
  int entering_ = -1, pivots_ = 0;
};

Lemke::Lemke(const Lcp& problem, double slant)
    : problem_(problem),
      n_(static_cast<int>(problem.size())),
      scale_(n_),
      A_(problem.A),
      inverse_(MatX::Identity(n_, n_)),
      values_(problem.b),
      column_(n_),
      cover_(n_),
      basis_(static_cast<std::size_t>(n_)) {
  for (int i = 0; i < n_; ++i) {
    basis_[static_cast<std::size_t>(i)] = i;
    const double size = problem.A(i, i) > 0 ? problem.A(i, i) : 1.0;
    scale_[i] = std::exp2(std::round(0.5 * std::log2(size)));
  }
  for (int j = 0; j < n_; ++j) A_.col(j) = A_.col(j).cwiseQuotient(scale_) / scale_[j];
  values_ = values_.cwiseQuotient(scale_);
  size_ = n_ > 0 && !values_.isZero(0) ? values_.lpNorm<Eigen::Infinity>() : 1.0;
  values_ /= size_;
  b_ = values_;
  // Fractional parts of multiples of the golden ratio: spread evenly, in no order.
  for (int i = 0; i < n_; ++i) cover_[i] = 1 + slant * std::fmod(0.6180339887498949 * (i + 1), 1.0);
}

void Lemke::set_column(int unknown) {
  if (unknown == 2 * n_) {
    column_.noalias() = -(inverse_ * cover_);
  } else if (unknown >= n_) {
    column_.noalias() = -(inverse_ * A_.col(unknown - n_));
  } else {
    column_ = inverse_.col(unknown);
  }
  entering_ = unknown;
}

// Whether row i stops the entering unknown before row j does, on a tie by the rows of B^-1.
bool Lemke::before(int i, int j) const {
  const double ci = column_[i], cj = column_[j];
  const auto compare = [](double a, double b) {
    if (std::abs(a - b) <= kTie * std::max({1.0, std::abs(a), std::abs(b)})) return 0;
    return a < b ? -1 : 1;
  };
  if (const int first = compare(values_[i] / ci, values_[j] / cj)) return first < 0;
  if (basis_[static_cast<std::size_t>(i)] == 2 * n_) return true;  // z_0 leaves if it can: that is the end
  if (basis_[static_cast<std::size_t>(j)] == 2 * n_) return false;
  for (int k = 0; k < n_; ++k) {
    if (const int order = compare(inverse_(i, k) / ci, inverse_(j, k) / cj)) return order < 0;
  }
  return false;
}

int Lemke::leaving_row(double least) const {
  const double smallest = least * column_.lpNorm<Eigen::Infinity>();
  int row = -1;
  for (int i = 0; i < n_; ++i) {
    if (column_[i] > smallest && (row < 0 || before(i, row))) row = i;
  }
  return row;
}

void Lemke::exchange(int row, int entering) {
  const double pivot = column_[row];
  const Eigen::RowVectorXd of_row = inverse_.row(row) / pivot;
  const double value = values_[row] / pivot;
  column_[row] = 0;
  inverse_.noalias() -= column_ * of_row;
  values_ -= value * column_;
  inverse_.row(row) = of_row;
  values_[row] = value;
  basis_[static_cast<std::size_t>(row)] = entering;
  ++pivots_;
}

MatX Lemke::basis_matrix() const {
  MatX B = MatX::Zero(n_, n_);
  for (int p = 0; p < n_; ++p) {
    const int unknown = basis_[static_cast<std::size_t>(p)];
    if (unknown == 2 * n_) {
      B.col(p) = -cover_;
    } else if (unknown >= n_) {
      B.col(p) = -A_.col(unknown - n_);
    } else {
      B(unknown, p) = 1;
    }
  }
  return B;
}

// Round-off accumulates in a matrix that is exchanged column by column.
void Lemke::refresh_if_drifted() {
  const MatX B = basis_matrix();
  const VecX all = VecX::Ones(n_);
  const double drift = std::max((B * values_ - b_).lpNorm<Eigen::Infinity>(),
                                (B * (inverse_ * all) - all).lpNorm<Eigen::Infinity>());
  if (drift <= kDrift) return;
  inverse_ = B.partialPivLu().inverse();
  values_ = inverse_ * b_;
  values_ += inverse_ * (b_ - B * values_);
}

Status Lemke::run(int limit) {
  if (n_ == 0 || values_.minCoeff() >= 0) return Status::solved;

  // z_0 enters for the row that needs it most, the last of them on a tie: then all others are w >= 0.
  int row = 0;
  for (int i = 1; i < n_; ++i) {
    if (values_[i] / cover_[i] <= values_[row] / cover_[row]) row = i;
  }
  set_column(2 * n_);
  int left = basis_[static_cast<std::size_t>(row)];
  exchange(row, 2 * n_);

  // The complement of the unknown that leaves is the next to enter.
  while (left != 2 * n_) {
    if (pivots_ >= limit) return Status::limit;
    set_column(complement(left));
    row = leaving_row(kEntry);
    if (row < 0) row = leaving_row(kLeastEntry);
    if (row < 0) return Status::ray;
    left = basis_[static_cast<std::size_t>(row)];
    exchange(row, entering_);
    if (pivots_ % kLookEvery == 0) refresh_if_drifted();
  }
  return Status::solved;
}

VecX Lemke::impulses() const {
  VecX z = VecX::Zero(n_);
  for (int p = 0; p < n_; ++p) {
    const int i = basis_[static_cast<std::size_t>(p)] - n_;
    if (i >= 0 && i < n_ && values_[p] > 0) z[i] = values_[p] / scale_[i] * size_;
  }
  return z;
}

std::vector<int> Lemke::active() const {
  std::vector<int> rows;
  for (const int unknown : basis_) {
    if (unknown >= n_ && unknown < 2 * n_) rows.push_back(unknown - n_);
  }
  return rows;
}

VecX Lemke::ray() const {
  VecX y = VecX::Zero(n_);
  if (entering_ >= n_ && entering_ < 2 * n_) y[entering_ - n_] = 1 / scale_[entering_ - n_];
  for (int p = 0; p < n_; ++p) {
    const int i = basis_[static_cast<std::size_t>(p)] - n_;
    if (i >= 0 && i < n_) y[i] = std::max(0.0, -column_[p]) / scale_[i];
  }
  return y;
}

}  // namespace

LcpResult solve_lemke(const Lcp& problem, const SolveOptions& options) {
  check_arguments(problem);
  if (problem.boxed()) return refused(problem, Status::unsuited);
  const int limit = options.limit > 0 ? options.limit : 100 + 50 * static_cast<int>(problem.size());
  LcpResult first;
  int pivots = 0;
  for (const double slant : kSlants) {
    Lemke method(problem, slant);
    const Status status = method.run(limit - pivots);
    LcpResult result = judged(problem, method.impulses(), status);
    pivots += method.pivots();
    if (status == Status::solved) polish(problem, method.active(), result);
    if (status == Status::ray) result.certificate = no_solution_certificate(problem, method.ray());
    if (result.certificate.size() > 0) result.status = Status::no_solution;
    result.pivots = pivots;
    if (result.status == Status::solved || result.status == Status::no_solution) return result;
    if (slant == kSlants.front()) first = std::move(result);
    if (pivots >= limit) break;
  }
  first.pivots = pivots;
  return first;
}

}  // namespace fc::lcp

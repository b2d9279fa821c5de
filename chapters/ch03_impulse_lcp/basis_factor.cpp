#include "ch03_impulse_lcp/basis_factor.hpp"

#include <algorithm>

namespace fc::lcp {
namespace {

// Up to this size plain loops are faster than a library's kernels, which pay off on long columns.
constexpr int kSmall = 24;
// The number of columns factored at a time: the block of L that they use, kPanel by kPanel, fits the
// first-level cache.
constexpr int kPanel = 48;

template <class Real>
using Segment = Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, 1>>;

// x := L^-1 x, with the k by k unit lower triangle of L.
template <class Matrix, class Real>
void solve_lower(const Matrix& L, int k, Real* x) {
  if (k > kSmall) {
    Segment<Real> segment(x, k);
    L.topLeftCorner(k, k).template triangularView<Eigen::UnitLower>().solveInPlace(segment);
    return;
  }
  for (int j = 0; j < k; ++j) {
    const Real* column = L.data() + j * L.outerStride();
    const Real xj = x[j];
    for (int i = j + 1; i < k; ++i) x[i] -= column[i] * xj;
  }
}

// x := L'^-1 x.
template <class Matrix, class Real>
void solve_lower_transposed(const Matrix& L, int k, Real* x) {
  if (k > kSmall) {
    Segment<Real> segment(x, k);
    L.topLeftCorner(k, k).template triangularView<Eigen::UnitLower>().transpose().solveInPlace(segment);
    return;
  }
  for (int j = k - 2; j >= 0; --j) {
    const Real* column = L.data() + j * L.outerStride();
    Real sum = x[j];
    for (int i = j + 1; i < k; ++i) sum -= column[i] * x[i];
    x[j] = sum;
  }
}

// to := to - factor from, for the entries first ... last - 1 of two columns.
template <class Real>
void subtract(Real* __restrict to, const Real* __restrict from, Real factor, int first, int last) {
  for (int r = first; r < last; ++r) to[r] -= factor * from[r];
}

// Cuts row and column `position` out of the k by k triangle L; `cut` receives that column below its diagonal.
template <class Matrix, class Real>
void cut_out(Matrix& L, int k, int position, Real* cut) {
  Real* const column = L.data() + position * L.outerStride();
  std::copy(column + position + 1, column + k, cut);
  for (int j = 0; j < position; ++j) {
    Real* c = L.data() + j * L.outerStride();
    std::copy(c + position + 1, c + k, c + position);
  }
  for (int j = position + 1; j < k; ++j) {
    const Real* from = L.data() + j * L.outerStride();
    std::copy(from + j + 1, from + k, L.data() + (j - 1) * L.outerStride() + j);
  }
}

}  // namespace

template <class Real>
void BasisFactor<Real>::reset(const Matrix& A, const Matrix& transposed, int n) {
  A_ = &A;
  transposed_ = &transposed;
  rows_.clear();
  candidate_row_ = -1;
  if (L_.rows() < n || (!symmetric() && U_.rows() < n)) {
    L_.resize(A.rows(), A.rows());
    if (!symmetric()) U_.resize(A.rows(), A.rows());
  }
  if (D_.size() < n) {
    for (Vector* v : {&D_, &lower_, &upper_}) v->resize(A.rows());
    rows_.reserve(static_cast<std::size_t>(A.rows()));
  }
}

template <class Real>
Real BasisFactor<Real>::schur(int i) {
  const int k = size();
  const Real* column = A_->data() + i * A_->outerStride();
  for (int p = 0; p < k; ++p) lower_[p] = column[row(p)];
  solve_lower(L_, k, lower_.data());  // L^-1 A_Ci = D u: of a symmetric A also D l
  Real schur = column[i];
  if (symmetric()) {
    for (int p = 0; p < k; ++p) {
      const Real y = lower_[p];
      lower_[p] = y / D_[p];
      schur -= y * lower_[p];
    }
  } else {
    const Real* row_i = transposed_->data() + i * transposed_->outerStride();
    for (int p = 0; p < k; ++p) {
      upper_[p] = lower_[p] / D_[p];
      lower_[p] = row_i[row(p)];
    }
    solve_lower(U_, k, lower_.data());
    for (int p = 0; p < k; ++p) schur -= lower_[p] * upper_[p];
    for (int p = 0; p < k; ++p) lower_[p] /= D_[p];
  }
  candidate_row_ = i;
  candidate_schur_ = schur;
  return schur;
}

template <class Real>
void BasisFactor<Real>::candidate_column(Real* x) const {
  const Vector& u = symmetric() ? lower_ : upper_;
  std::copy(u.data(), u.data() + size(), x);
  solve_lower_transposed(U(), size(), x);
}

template <class Real>
void BasisFactor<Real>::enter() {
  const int k = size();
  for (int p = 0; p < k; ++p) L_(k, p) = lower_[p];
  if (!symmetric()) {
    for (int p = 0; p < k; ++p) U_(k, p) = upper_[p];
  }
  D_[k] = candidate_schur_;
  rows_.push_back(candidate_row_);
}

template <class Real>
void BasisFactor<Real>::leave(int position) {
  const int k = size(), left = k - 1;
  // Without row and column `position`, the block after it has lost d l u': the product of what was cut.
  Real* const l = lower_.data() + position;
  Real* const u = symmetric() ? l : upper_.data() + position;
  cut_out(L_, k, position, l);
  if (!symmetric()) cut_out(U_, k, position, u);
  Real d = D_[position];
  std::copy(D_.data() + position + 1, D_.data() + k, D_.data() + position);
  rows_.erase(rows_.begin() + position);

  // Add it again, column by column (Bennett 1965): L D U + d l u'.
  for (int j = position; j < left; ++j) {
    const Real lj = lower_[j], uj = symmetric() ? lj : upper_[j];
    const Real old = D_[j];
    D_[j] = old + d * lj * uj;
    const Real step_l = d * uj / D_[j], step_u = d * lj / D_[j];
    d *= old / D_[j];
    Real* const column_l = L_.data() + j * L_.outerStride();
    Real* const rest_l = lower_.data();
    for (int i = j + 1; i < left; ++i) {
      rest_l[i] -= lj * column_l[i];
      column_l[i] += step_l * rest_l[i];
    }
    if (symmetric()) continue;
    Real* const column_u = U_.data() + j * U_.outerStride();
    Real* const rest_u = upper_.data();
    for (int i = j + 1; i < left; ++i) {
      rest_u[i] -= uj * column_u[i];
      column_u[i] += step_u * rest_u[i];
    }
  }
}

template <class Real>
void BasisFactor<Real>::factor(const std::vector<int>& wanted, Real threshold) {
  rows_.clear();
  if (symmetric() && static_cast<int>(wanted.size()) > kSmall) {
    rows_ = wanted;
    factor_symmetric(threshold);
    return;
  }
  for (const int i : wanted) {
    if (schur(i) > threshold) enter();
  }
}

// L D L' by blocks of columns: the diagonal block by hand, what is below it by a triangular solve, and the
// rest of the matrix by one product of matrices, which does nearly all the work.
template <class Real>
void BasisFactor<Real>::factor_symmetric(Real threshold) {
  const int k = size();
  for (int q = 0; q < k; ++q) {
    const Real* column = A_->data() + row(q) * A_->outerStride();
    for (int p = q; p < k; ++p) L_(p, q) = column[row(p)];
  }
  if (panel_.rows() < L_.rows()) panel_.resize(L_.rows(), kPanel);
  dropped_.assign(static_cast<std::size_t>(k), 0);

  for (int first = 0; first < k; first += kPanel) {
    const int width = std::min(kPanel, k - first), below = k - first - width;
    auto diagonal = L_.block(first, first, width, width);
    for (int j = 0; j < width; ++j) {
      Real& d = D_[first + j];
      d = diagonal(j, j);
      const bool drop = !(d > threshold);
      if (drop) {  // the row takes no part: its column is zero
        dropped_[static_cast<std::size_t>(first + j)] = 1;
        d = 1;
        diagonal.col(j).tail(width - j - 1).setZero();
        continue;
      }
      Real* const column = &diagonal(0, j);
      for (int i = j + 1; i < width; ++i) subtract(&diagonal(0, i), column, column[i] / d, i, width);
      diagonal.col(j).tail(width - j - 1) /= d;
    }
    if (below == 0) break;
    auto under = L_.block(first + width, first, below, width);
    diagonal.template triangularView<Eigen::UnitLower>().transpose().template solveInPlace<Eigen::OnTheRight>(
        under);
    auto product = panel_.topLeftCorner(below, width);
    for (int j = 0; j < width; ++j) {
      if (dropped_[static_cast<std::size_t>(first + j)]) under.col(j).setZero();
      product.col(j) = under.col(j);
      under.col(j) /= D_[first + j];
    }
    auto rest = L_.block(first + width, first + width, below, below);
    rest.template triangularView<Eigen::Lower>() -= product * under.transpose();
  }

  // Close the gaps left by dropped rows.
  if (std::find(dropped_.begin(), dropped_.end(), 1) == dropped_.end()) return;
  int kept = 0;
  for (int q = 0; q < k; ++q) {
    if (dropped_[static_cast<std::size_t>(q)]) continue;
    int to = kept;
    for (int p = q; p < k; ++p) {
      if (!dropped_[static_cast<std::size_t>(p)]) L_(to++, kept) = L_(p, q);
    }
    D_[kept] = D_[q];
    rows_[static_cast<std::size_t>(kept++)] = rows_[static_cast<std::size_t>(q)];
  }
  rows_.resize(static_cast<std::size_t>(kept));
}

template <class Real>
void BasisFactor<Real>::solve(Real* x) const {
  const int k = size();
  solve_lower(L_, k, x);
  for (int p = 0; p < k; ++p) x[p] /= D_[p];
  solve_lower_transposed(U(), k, x);
}

template class BasisFactor<double>;
template class BasisFactor<long double>;

}  // namespace fc::lcp

#include "ch03_impulse_lcp/basis_factor.hpp"

#include <cmath>

namespace fc::lcp {

BasisFactor::BasisFactor(const MatX& A) : A_(A), L_(MatX::Zero(A.rows(), A.rows())), candidate_(A.rows()) {
  rows_.reserve(static_cast<std::size_t>(A.rows()));
}

double BasisFactor::schur(int i) {
  const int k = size();
  for (int p = 0; p < k; ++p) candidate_[p] = A_(row(p), i);
  L_.topLeftCorner(k, k).triangularView<Eigen::Lower>().solveInPlace(candidate_.head(k));
  candidate_row_ = i;
  candidate_schur_ = A_(i, i) - candidate_.head(k).squaredNorm();
  return candidate_schur_;
}

void BasisFactor::enter() {
  const int k = size();
  L_.row(k).head(k) = candidate_.head(k).transpose();
  L_(k, k) = std::sqrt(candidate_schur_);
  rows_.push_back(candidate_row_);
}

void BasisFactor::leave(int position) {
  const int last = size() - 1;
  // The column that is cut, below its diagonal entry: what the rows after `position` lose with it.
  VecX& cut = candidate_;
  for (int i = position; i < last; ++i) cut[i] = L_(i + 1, position);
  for (int i = position; i < last; ++i) {
    for (int j = 0; j < position; ++j) L_(i, j) = L_(i + 1, j);
    for (int j = position; j <= i; ++j) L_(i, j) = L_(i + 1, j + 1);
  }
  rows_.erase(rows_.begin() + position);

  // Give the loss back: L22 L22' + cut cut' is a product of Givens rotations, one for each column.
  for (int j = position; j < last; ++j) {
    const double radius = std::hypot(L_(j, j), cut[j]);
    const double c = L_(j, j) / radius, s = cut[j] / radius;
    L_(j, j) = radius;
    for (int i = j + 1; i < last; ++i) {
      const double below = L_(i, j);
      L_(i, j) = c * below + s * cut[i];
      cut[i] = c * cut[i] - s * below;
    }
  }
}

void BasisFactor::solve(Eigen::Ref<VecX> x) const {
  const auto L = L_.topLeftCorner(size(), size());
  L.triangularView<Eigen::Lower>().solveInPlace(x);
  L.transpose().triangularView<Eigen::Upper>().solveInPlace(x);
}

}  // namespace fc::lcp

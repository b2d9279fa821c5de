// The triangular factors of the rows and columns of A that are in the basis, kept up to date as rows enter
// and leave.
#pragma once

#include <vector>

#include "common/types.hpp"

namespace fc::lcp {

// A_CC = L D U for a growing and shrinking list C of rows (the basis, in the order of entry); L is unit lower
// and U unit upper triangular, D diagonal. For a symmetric A, U = L' and is not stored. Rows are never
// exchanged for stability: the matrices of this chapter have positive principal minors, so every D is
// positive in any order of the rows.
//   factor: all rows at once, by blocks (for symmetric A), O(k^3 / 3) multiplications and additions together;
//   enter:  one triangular solve gives the new row of L, O(k^2);
//   leave:  the row is cut out, and the block of L below it takes a rank-one update by the column that was
//   cut, O(k^2).
//           For a symmetric A it adds a positive term: it cannot fail, and is as stable as a new
//           factorisation.
// Takes no square roots. Holds a pointer to A, which must outlive it. Allocates only when n grows.
template <class Real>
class BasisFactor {
 public:
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  // An empty basis. A: the leading n by n block of this matrix; transposed: the same block of A', or A itself
  // if that is symmetric.
  void reset(const Matrix& A, const Matrix& transposed, int n);

  int size() const { return static_cast<int>(rows_.size()); }
  int row(int position) const { return rows_[static_cast<std::size_t>(position)]; }
  const std::vector<int>& rows() const { return rows_; }

  // The Schur complement A_ii - A_iC A_CC^-1 A_Ci of a row outside the basis: what is left of A_ii once the
  // rows of C have been held at w = 0. Zero, up to round-off, if row i is a combination of those of C. The
  // row is kept ready for candidate_column() and enter().
  Real schur(int i);

  // x := A_CC^-1 A_Ci for the row of the last schur(): size() entries in the basis's order.
  void candidate_column(Real* x) const;

  // Puts the row of the last schur() at the end of the basis. That Schur complement must not be zero.
  void enter();
  void leave(int position);

  // The basis becomes the rows of `wanted`, in that order, without those whose Schur complement against the
  // ones before is `threshold` or less.
  void factor(const std::vector<int>& wanted, Real threshold);

  // x := A_CC^-1 x; x has size() entries in the basis's order.
  void solve(Real* x) const;

 private:
  bool symmetric() const { return A_ == transposed_; }
  const Matrix& U() const { return symmetric() ? L_ : U_; }
  void factor_symmetric(Real threshold);

  const Matrix* A_ = nullptr;
  const Matrix* transposed_ = nullptr;
  Matrix L_, U_;           // below the diagonal of their leading size() rows: L, and the transpose of U
  Vector D_;               // size()
  std::vector<int> rows_;  // C
  Vector lower_, upper_;   // the candidate's row of L and column of U
  Matrix panel_;           // a block column of L D, while all rows are factored
  std::vector<char> dropped_;
  int candidate_row_ = -1;
  Real candidate_schur_ = 0;
};

extern template class BasisFactor<double>;
extern template class BasisFactor<long double>;

}  // namespace fc::lcp

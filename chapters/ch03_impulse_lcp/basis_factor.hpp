// The Cholesky factor of the rows and columns of A that are in the basis, kept up to date as rows enter and
// leave.
#pragma once

#include <vector>

#include "common/types.hpp"

namespace fc::lcp {

// L L' = A_CC for a growing and shrinking list C of rows (the basis, in the order of entry).
//   enter: one triangular solve gives the new row of L, O(k^2);
//   leave: the row is cut out, and the block of L below it takes a rank-one update by the column that was
//   cut, O(k^2).
//          The update adds a positive term, so it cannot fail, and it is as stable as a new factorisation.
// Holds a reference to A, which must outlive it. Allocates only when constructed.
class BasisFactor {
 public:
  explicit BasisFactor(const MatX& A);

  int size() const { return static_cast<int>(rows_.size()); }
  int row(int position) const { return rows_[static_cast<std::size_t>(position)]; }
  const std::vector<int>& rows() const { return rows_; }

  // The Schur complement A_ii - A_iC A_CC^-1 A_Ci of a row outside the basis: what is left of A_ii once the
  // rows of C have been held at w = 0. Zero, up to round-off, if row i is a combination of those of C. The
  // row is kept ready for enter().
  double schur(int i);

  // Puts the row of the last call of schur() at the end of the basis. That Schur complement must have been
  // positive.
  void enter();
  void leave(int position);

  // x := A_CC^-1 x; x has size() entries in the basis's order.
  void solve(Eigen::Ref<VecX> x) const;

 private:
  const MatX& A_;
  MatX L_;                 // lower triangle of the leading size() rows
  std::vector<int> rows_;  // C
  VecX candidate_;         // L^-1 A_Ci of the last schur()
  int candidate_row_ = -1;
  double candidate_schur_ = 0;
};

}  // namespace fc::lcp

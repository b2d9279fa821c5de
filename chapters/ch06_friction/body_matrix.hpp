// A symmetric positive definite matrix with a row of blocks, six by six, for each body, and its Cholesky factor. Bodies that
// touch nobody in common have zeros between them, and most of these stay zero in the factor too, if bodies are eliminated in a
// good order: next is the body with the fewest neighbours left (approximate minimum degree: Amestoy, Davis, Duff 1996).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "common/types.hpp"

namespace fc::friction {

class BodyMatrix {
 public:
  using Mat6 = Eigen::Matrix<double, 6, 6>;

  // Sets the matrix to zero, for this number of bodies. links: the pairs of different bodies that may have a block. If they are
  // those of the last time, so is the order of elimination.
  void start(int bodies, std::span<const std::pair<int, int>> links);
  // Adds a block to row i and column j, and its transpose to row j and column i, if that is another place.
  void add(int i, int j, const Mat6& block);
  // From now on the matrix is its factor, until the next start().
  void factor();
  // The inverse's product with x, of six entries a body.
  VecX solve(const VecX& x) const;

 private:
  void order(std::span<const std::pair<int, int>> links);

  std::vector<std::pair<int, int>> links_;
  std::vector<int> place_;  // of each body, in the order of elimination
  std::vector<int> first_;  // of each column, its first block below the diagonal, and one more
  std::vector<int> rows_;   // of each of these, ascending in a column
  std::vector<Mat6> below_, diagonal_;
};

}  // namespace fc::friction

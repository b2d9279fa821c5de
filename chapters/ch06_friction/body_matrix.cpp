#include "ch06_friction/body_matrix.hpp"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

#include "ch06_friction/contact_block.hpp"

namespace fc::friction {
namespace {

using Mat6 = BodyMatrix::Mat6;
using Vec6 = Eigen::Matrix<double, 6, 1>;

// The inverse of L, where L L' = A.
Mat6 inverse_root(const Mat6& A) {
  const Mat6 L = Eigen::LLT<Mat6>(A).matrixL();
  Mat6 inverse = Mat6::Zero();
  for (int column = 0; column < 6; ++column) {
    inverse(column, column) = 1 / L(column, column);
    for (int row = column + 1; row < 6; ++row) {
      double sum = 0;
      for (int k = column; k < row; ++k) sum += L(row, k) * inverse(k, column);
      inverse(row, column) = -sum / L(row, row);
    }
  }
  return inverse;
}

}  // namespace

void BodyMatrix::start(int bodies, std::span<const std::pair<int, int>> links) {
  const auto count = static_cast<std::size_t>(bodies);
  if (count != place_.size() || !std::equal(links.begin(), links.end(), links_.begin(), links_.end())) {
    place_.resize(count);
    order(links);
  }
  diagonal_.assign(count, Mat6::Zero());
  below_.assign(rows_.size(), Mat6::Zero());
}

// A column of the factor has the blocks of the matrix's column, and those of each column of which it is the first row.
void BodyMatrix::order(std::span<const std::pair<int, int>> links) {
  links_.assign(links.begin(), links.end());
  const int count = static_cast<int>(place_.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [i, j] : links) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Eigen::SparseMatrix<double> touches(count, count);
  touches.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> next;
  Eigen::AMDOrdering<int>()(touches, next);
  for (int k = 0; k < count; ++k) place_[static_cast<std::size_t>(next.indices()[k])] = k;

  std::vector<std::vector<int>> columns(place_.size());
  for (const auto& [i, j] : links) {
    const int p = place_[index(i)], q = place_[index(j)];
    columns[static_cast<std::size_t>(std::min(p, q))].push_back(std::max(p, q));
  }
  first_.assign(1, 0);
  rows_.clear();
  for (std::vector<int>& column : columns) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    rows_.insert(rows_.end(), column.begin(), column.end());
    first_.push_back(static_cast<int>(rows_.size()));
    if (column.empty()) continue;
    std::vector<int>& parent = columns[static_cast<std::size_t>(column.front())];
    parent.insert(parent.end(), column.begin() + 1, column.end());
  }
}

void BodyMatrix::add(int i, int j, const Mat6& block) {
  const int p = place_[index(i)], q = place_[index(j)];
  if (p == q) {
    diagonal_[static_cast<std::size_t>(p)] += block;
    return;
  }
  const auto column = static_cast<std::size_t>(std::min(p, q));
  const auto found =
      std::lower_bound(rows_.begin() + first_[column], rows_.begin() + first_[column + 1], std::max(p, q));
  Mat6& there = below_[static_cast<std::size_t>(found - rows_.begin())];
  if (p > q)
    there += block;
  else
    there += block.transpose();
}

// ANCHOR: factor
void BodyMatrix::factor() {
  for (std::size_t k = 0; k < diagonal_.size(); ++k) {
    diagonal_[k] = inverse_root(diagonal_[k]);
    const auto first = static_cast<std::size_t>(first_[k]), end = static_cast<std::size_t>(first_[k + 1]);
    for (std::size_t e = first; e < end; ++e)
      below_[e] = Mat6(below_[e].lazyProduct(diagonal_[k].transpose()));
    for (std::size_t e = first; e < end; ++e) {  // of the rest, the row and the column of each
      const Mat6 across = below_[e].transpose();
      const auto column = static_cast<std::size_t>(rows_[e]);
      diagonal_[column].noalias() -= below_[e].lazyProduct(across);
      auto there = static_cast<std::size_t>(first_[column]);
      for (std::size_t f = e + 1; f < end; ++f) {
        while (rows_[there] != rows_[f]) ++there;
        below_[there].noalias() -= below_[f].lazyProduct(across);
      }
    }
  }
}
// ANCHOR_END: factor

VecX BodyMatrix::solve(const VecX& x) const {
  const auto part = [](VecX& v, int k) { return v.segment<6>(6 * static_cast<Eigen::Index>(k)); };
  const auto count = static_cast<int>(place_.size());
  VecX y(x.size()), result(x.size());
  for (int body = 0; body < count; ++body)
    part(y, place_[index(body)]) = x.segment<6>(6 * static_cast<Eigen::Index>(body));
  for (int k = 0; k < count; ++k) {
    const Vec6 own = part(y, k) = (diagonal_[index(k)] * part(y, k)).eval();
    for (int e = first_[index(k)]; e < first_[index(k) + 1]; ++e)
      part(y, rows_[index(e)]).noalias() -= below_[index(e)] * own;
  }
  for (int k = count - 1; k >= 0; --k) {
    Vec6 own = part(y, k);
    for (int e = first_[index(k)]; e < first_[index(k) + 1]; ++e)
      own.noalias() -= below_[index(e)].transpose() * part(y, rows_[index(e)]);
    part(y, k).noalias() = diagonal_[index(k)].transpose() * own;
  }
  for (int body = 0; body < count; ++body) part(result, body) = part(y, place_[index(body)]);
  return result;
}

}  // namespace fc::friction

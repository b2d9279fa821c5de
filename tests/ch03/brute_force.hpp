// The slowest and surest LCP solver: tries every active set.
#pragma once

#include <Eigen/QR>
#include <optional>
#include <vector>

#include "common/types.hpp"

namespace fc::lcp {

// Tries all 2^n sets of rows with w = 0 (n <= 12), and returns the first whose z and w are nonnegative to
// within `tolerance`, or nothing: then no solution exists. For symmetric positive semidefinite A it is enough
// to try sets whose block of A is regular: a solution at an extreme point of the solution set has one.
inline std::optional<VecX> brute_force(const MatX& A, const VecX& b, double tolerance) {
  const int n = static_cast<int>(b.size());
  for (unsigned set = 0; set < (1u << n); ++set) {
    std::vector<int> rows;
    for (int i = 0; i < n; ++i) {
      if (set >> i & 1u) rows.push_back(i);
    }
    VecX z = VecX::Zero(n);
    if (!rows.empty()) {
      const Eigen::ColPivHouseholderQR<MatX> qr(A(rows, rows));
      if (!qr.isInvertible()) continue;
      z(rows) = qr.solve(-b(rows));
    }
    const VecX w = A * z + b;
    if (z.minCoeff() >= -tolerance && w.minCoeff() >= -tolerance) return z;
  }
  return std::nullopt;
}

}  // namespace fc::lcp

// Dantzig's principal pivoting method for the LCP of frictionless impacts.
#pragma once

#include "ch03_impulse_lcp/problem.hpp"

namespace fc::lcp {

struct DantzigOptions {
  // After so many exchanges the answer is `limit`; 0 means 100 + 50 n. Contact problems take about n, but
  // there are families whose number of pivots doubles with every row (Murty 1978), and no limit would help
  // those.
  int max_pivots = 0;
};

// Solves w = A z + b, z >= 0, w >= 0, z'w = 0 for a symmetric positive semidefinite A (the paper, section 4,
// names the problem; the method is Dantzig's, in Cottle and Dantzig 1968, as Baraff 1994 uses it for
// contacts).
//   A: n by n, any rank; zero rows are allowed. Units do not matter: rows are scaled by powers of two inside.
//   b: n.
// One row after the other is driven to w >= 0 by raising its z, while all rows done before stay
// complementary. Status: solved       the result passed acceptable(); the residual is then at round-off level
// unless A is nearly singular;
//         no_solution  a certificate was found and checked against A itself;
//         limit        too many pivots, or the end result failed acceptable();
//         unsuited     A is not symmetric, or was found not to be positive semidefinite.
// Where A is singular, w is unique but z is not: z is then one of the solutions, at most rank(A) of its
// entries are not 0. The order of the rows may select another z. The cost is O(n^2) for each pivot. Throws
// std::invalid_argument for sizes that do not match and for entries that are not finite.
LcpResult solve_dantzig(const Lcp& problem, const DantzigOptions& options = {});

}  // namespace fc::lcp

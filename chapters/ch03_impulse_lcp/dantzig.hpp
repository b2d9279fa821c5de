// Dantzig's principal pivoting method for the LCP of impacts.
#pragma once

#include <memory>

#include "ch03_impulse_lcp/problem.hpp"

namespace fc::lcp {

struct DantzigOptions {
  // After this many exchanges the status is `limit`; 0 means 100 + 50 n. Contact problems take about n. There
  // are families whose number of pivots doubles with every row (Murty 1978); no limit helps with those.
  int max_pivots = 0;
  // n, a guess of z, for example the last step's: the solve begins with those rows in the basis whose guess
  // lies strictly within the bounds. A wrong guess costs time, never the answer. Null: none.
  const VecX* start = nullptr;
  // From 20 rows on, begin with a predicted basis, factored at once. False: row by row from an empty basis.
  bool predict = true;
};

// Solves w = A z + b, z >= 0, w >= 0, z'w = 0, or the form with bounds, for a symmetric positive semidefinite
// A of any rank, or for a P-matrix (all principal minors positive), symmetric or not. (The paper, section 4,
// names the problem; the method is Dantzig's, in Cottle and Dantzig 1968, as Baraff 1994 uses it for
// contacts.)
//   A: n by n; zero rows are allowed. Units do not matter: rows are scaled by powers of two inside.
//   b: n.
// One row after the other is driven, by changing its z_i, to where w_i allows it to stay; all rows done
// before stay complementary. Status:
//   solved        the result passed acceptable(); the residual is then at round-off level, unless A is nearly
//                 singular
//   no_solution   a certificate was found and checked against A itself
//   limit         too many pivots, or the end result failed acceptable()
//   unsuited      A was found to be neither positive semidefinite nor a P-matrix
// Where A is singular, w is unique but z is not: z is then one of the solutions, and at most rank(A) of its
// entries are not at a bound. The order of the rows and the guess may select another z. The cost is O(n^2)
// for each pivot.
//
// A solver keeps its memory: after the first solve of a size, it allocates nothing for problems of up to that
// size and fewer than 20 rows that succeed at the first attempt.
class DantzigSolver {
 public:
  DantzigSolver();
  ~DantzigSolver();
  DantzigSolver(DantzigSolver&&) noexcept;
  DantzigSolver& operator=(DantzigSolver&&) noexcept;

  // Throws std::invalid_argument as check_arguments() does.
  void solve(const Lcp& problem, const DantzigOptions& options, LcpResult& result);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

// The same, once.
LcpResult solve_dantzig(const Lcp& problem, const DantzigOptions& options = {});

}  // namespace fc::lcp

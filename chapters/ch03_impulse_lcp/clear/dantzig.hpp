// Dantzig's method in its clear form: dense, the basis factored anew at each pivot.
#pragma once

#include "ch03_impulse_lcp/problem.hpp"

namespace fc::lcp::clear {

// Solves w = A z + b, z >= 0, w >= 0, z'w = 0, row after row, as in the chapter's text.
//   A:     n by n, symmetric, positive semidefinite, of any rank. Units do not matter: a common factor of A or of b changes
//          nothing, and rows may differ in theirs.
//   b:     n.
//   limit: the largest number of pivots; 0 means 100 + 50 n.
// Returns z, w, the pivots, and the status:
//   solved       (z, w) passed acceptable();
//   no_solution  `certificate` is a y >= 0 with A y = 0 and b'y < 0, and passed certifies_no_solution();
//   limit        too many pivots, or spoiled by round-off: neither is known.
// `residual` is left to the caller. A pivot costs a decomposition of the basis, up to 4/3 n^3 operations, where the fast
// form (../dantzig.hpp) updates its factors in n^2: for problems of up to about a hundred rows.
LcpResult dantzig(const MatX& A, const VecX& b, int limit);

}  // namespace fc::lcp::clear

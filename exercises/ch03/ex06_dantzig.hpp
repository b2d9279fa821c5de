// Exercise 3.6, a piece of the engine: Dantzig's method.
#pragma once

#include "ch03_impulse_lcp/problem.hpp"

namespace fc::mine {

// Solves w = A z + b, z >= 0, w >= 0, z'w = 0 by Dantzig's method, row after row, as in the chapter's text.
//   A:     n by n, 1/kg, symmetric, positive semidefinite, of any rank, zero rows included. A common factor of A or of b
//          (2^-40, 2^40) changes nothing, and rows may differ in their units.
//   b:     n, m/s; n may be 0.
//   limit: the largest number of pivots; 0 means 100 + 50 n.
// Returns
//   z            n, the impulses, N s, >= 0
//   w            n, A z + b, m/s: lcp::evaluate(A, b, z)
//   pivots       rows that entered or left the basis
//   status       solved: (z, w) passed lcp::acceptable();
//                no_solution: `certificate`, n, is a y >= 0 with A y = 0 and b'y < 0, and passed
//                lcp::certifies_no_solution();
//                limit: too many pivots, or spoiled by round-off
//   residual     not needed: the caller computes it
// Decomposing the basis anew at each pivot is fine.
lcp::LcpResult dantzig(const MatX& A, const VecX& b, int limit);

}  // namespace fc::mine

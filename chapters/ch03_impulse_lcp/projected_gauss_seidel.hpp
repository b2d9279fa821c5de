// Projected Gauss-Seidel: each row in turn is solved for its own z, with the others fixed, again and again.
#pragma once

#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp {

// z_i := clamp(z_i - w_i / A_ii) for i = 1 ... n is one sweep (Cottle, Pang and Stone 1992, section 5.2, the
// splitting into the lower triangle and the rest; "sequential impulses" in games). Converges for symmetric
// positive semidefinite matrices with a positive diagonal. The rate depends on the matrix: heavy bodies on
// light ones need very many sweeps.
//   limit: sweeps; 0 means 10,000. tolerance: the residual that ends it, computed every 10 sweeps; 0 means
//   1e-10. start: where it begins; null: z = 0 (the bounds permitting).
// Status: solved if the residual reached the tolerance and passed acceptable(); no_solution for a row that is
// zero while its b is not (w_i = b_i < 0); limit; unsuited for a diagonal entry that is not positive though
// its row is not zero. `pivots` counts the sweeps. The cost of one is n^2 multiplications.
LcpResult solve_pgs(const Lcp& problem, const SolveOptions& options = {});

}  // namespace fc::lcp

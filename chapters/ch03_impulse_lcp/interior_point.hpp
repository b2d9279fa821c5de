// An interior-point method: Newton's method on a problem whose corner is rounded off, less and less.
#pragma once

#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp {

// Newton steps for A z + b - w = 0 and z_i w_i = mu with all z, w > 0, mu falling to 0 (Mehrotra 1992,
// predictor and corrector, for the monotone LCP as in Wright, Primal-Dual Interior-Point Methods, 1997,
// chapter 8). Each step solves one n by n system, (A + diag(w / z)) dz = r, twice; their number hardly
// depends on n.
//   A: positive semidefinite, symmetric or not, of any rank.
//   limit: steps; 0 means 100. tolerance: the residual that ends it; 0 means 1e-10. start is ignored: a guess
//   on the boundary is no use to a method that moves in the interior.
// At the end the rows with z_i > w_i are solved for w_i = 0 exactly, if that makes the residual smaller.
// Status: solved; no_solution, where the iterates grow along a direction that is a certificate; limit;
// unsuited for bounds, or if the system of a step has no Cholesky factor. `pivots` counts the steps.
LcpResult solve_interior_point(const Lcp& problem, const SolveOptions& options = {});

}  // namespace fc::lcp

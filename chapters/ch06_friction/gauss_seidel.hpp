// Nonlinear Gauss-Seidel: one contact after the other is solved exactly, as if all others were known, again and again.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// r_i := (1-ω) r_i + ω one_contact(A_ii, b_i + Σ_{j≠i} A_ij r_j) for every contact is one sweep (Jean and Moreau
// 1992); sweeps go forwards and backwards by turns. No theorem says that it converges. The residual is watched: where
// the best of kWatch sweeps is not clearly below the best before them, sweeps go in circles, and ω is halved. A relaxed
// impulse stays in its cone, because cones are convex.
//   limit: sweeps; 0 means 2,000. start: where it begins.
// No heap allocation between two sweeps. A sweep costs (3n)² multiplications, less where impulses do not change.
ConeResult solve_gauss_seidel(const ConeProblem& problem, const SolveOptions& options = {});

}  // namespace fc::friction

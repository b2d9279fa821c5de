// Nonlinear Gauss-Seidel: contact after contact is solved exactly, as if all others were known, again and again.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// r_i := (1-ω) r_i + ω one_contact(A_ii, b_i + Σ_{j≠i} A_ij r_j) for every contact is one sweep (Jean and Moreau
// 1992); sweeps go forwards and backwards by turns. No theorem says that it converges. Sweeps watch the residual:
// where the best of kWatch sweeps is not clearly below the best before them, they go in circles, and ω is halved.
// A relaxed answer of a cone stays in it, because cones are convex.
//   limit: sweeps; 0 means 2,000. start: where it begins.
// Takes nothing from the heap between two sweeps. A sweep costs (3n)² multiplications, less where impulses rest.
ConeResult solve_gauss_seidel(const ConeProblem& problem, const SolveOptions& options = {});

}  // namespace fc::friction

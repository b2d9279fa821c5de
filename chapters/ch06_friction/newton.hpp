// Newton's method for the frictional contact problem: a few steps near an answer, no promise far from one.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// Solves F(r) = 0, Alart and Curnier's function (1991), by semismooth Newton steps. With x = r - u/s of a contact (s
// its scale, 1/kg) there are three cases, linear except for the direction of the slip:
//   open   x_N <= 0:          F = s r
//   stick  |x_T| <= µ x_N:    F = u
//   slip   else:              F_N = u_N,   F_T = s (r_T - µ x_N x_T/|x_T|)
// The matrix is singular wherever contacts are redundant, as the four corners of a box are. Of the many changes of r
// that solve, or nearly solve, the linear problem, the smallest is taken (a complete orthogonal decomposition). Every
// step is taken in full. F may grow for some steps, while contacts find their case; a line search, or a
// Levenberg-Marquardt term, would stop at the kinks between the cases.
//   limit: steps; 0 means 30. start: where it begins; some sweeps of Gauss-Seidel give a good one.
// Every r is projected onto the cones before it is checked; the one with the smallest residual is returned. A step
// decomposes a 3n by 3n matrix.
ConeResult solve_newton(const ConeProblem& problem, const SolveOptions& options = {});

}  // namespace fc::friction

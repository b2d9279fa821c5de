// Friction on a pyramid instead of a cone: a linear complementarity problem, solved by Lemke's method.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// Stewart and Trinkle's problem (1996). Friction is a sum of pushes β_k >= 0 along m = options.sides unit vectors d_k
// of the tangent plane; where a contact slides, λ is its speed:
//   w_N = u_N >= 0 ⟂ r_N >= 0,   w_k = d_k·u_T + λ >= 0 ⟂ β_k >= 0,   w_λ = µ r_N - Σ β_k >= 0 ⟂ λ >= 0.
// Lemke's method finds a solution for any µ (Anitescu and Potra 1997). But it solves the pyramid's problem: friction
// points along a side, up to π/m off the slip, and is too small by up to 1 - cos(π/m).
//   sides: m. With four, d_0 is tangent 1: a contact that sticks at 45° to it has only µ r_N/√2.
//   draw: 0: d_0 is tangent 1; else every contact's sides are turned by an angle of its own, different for each number.
//   turned: after each solve every sliding contact's pyramid is turned so that one side points against its slip; a few
//     rounds bring the answer near the cone's, though not always to it. False: one round.
//   limit: rounds; 0 means 8. start is ignored.
// A round solves an LCP of n (m + 2) rows. The best round's answer is returned; `solved` only if it also fits the cone.
ConeResult solve_pyramid(const ConeProblem& problem, const SolveOptions& options = {});

}  // namespace fc::friction

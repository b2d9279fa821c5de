// Friction on a pyramid instead of a cone: a linear complementarity problem, and Lemke's method solves it.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// Stewart and Trinkle's problem (1996). Friction is a sum of pushes β_k >= 0 along m = options.sides unit vectors d_k
// of the tangent plane, and λ is, where a contact slides, its speed:
//   w_N = u_N >= 0 ⟂ r_N >= 0,   w_k = d_k·u_T + λ >= 0 ⟂ β_k >= 0,   w_λ = µ r_N - Σ β_k >= 0 ⟂ λ >= 0.
// Lemke's method finds a solution whatever the µ (Anitescu and Potra 1997). But it is one of the pyramid: friction
// points along a side, off the slip by up to π/m, and is short by up to 1 - cos(π/m).
//   sides: m. With four, d_0 is tangent 1: what sticks at 45° to it has but µ r_N/√2.
//   draw: 0: d_0 is tangent 1; else every contact's sides are turned by an angle of its own, others for each number.
//   turned: after each solve every sliding contact's pyramid is turned so that one side points against its slip; few
//   rounds bring the answer near the cone's, though not always to it. False: one round.
//   limit: rounds; 0 means 8. start is ignored.
// A round solves an LCP of n (m + 2) rows. The best round's answer is returned; `solved` only if it is the cone's.
ConeResult solve_pyramid(const ConeProblem& problem, const SolveOptions& options = {});

}  // namespace fc::friction

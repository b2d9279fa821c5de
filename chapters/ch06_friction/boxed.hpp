// Friction in boxes: each tangent has bounds of its own. Exact in two dimensions; in three it is what engines are most
// often reported for.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// |r_T1| <= µ r_N and |r_T2| <= µ r_N, the bounds being numbers of the round before: chapter 3's method of Dantzig
// solves each round, and the next takes its bounds from the new normals, the first from those without friction.
// Where contacts have one tangent that moves, the rounds' end is Coulomb's law. Else it is another one: at 45° to the
// tangents friction is √2 µ r_N, and what slides there turns towards an axis; turning the tangents changes the motion.
//   limit: rounds; 0 means 50. They end when no normal velocity changes by more than 1e-12 of max|b|. start is ignored.
// `solved` only if the answer is the cone's; ConeResult::sweeps counts the rounds.
ConeResult solve_boxed(const ConeProblem& problem, const SolveOptions& options = {});

// Without friction: chapter 3's LCP of the normals alone, by Dantzig's method. mu is not looked at.
ConeResult solve_frictionless(const ConeProblem& problem, const SolveOptions& options = {});

}  // namespace fc::friction

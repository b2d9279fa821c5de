// Box friction: each tangent has bounds of its own. Exact in two dimensions; in three, a common source of complaints
// about engines.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// |r_T1| <= µ r_N and |r_T2| <= µ r_N, where the bounds are numbers from the round before. Chapter 3's method of
// Dantzig solves each round, and the next takes its bounds from the new normals; the first takes them from the solution
// without friction. If each contact has only one tangent that moves, the rounds end at Coulomb's law. Else they end at
// another law: at 45° to the tangents friction is √2 µ r_N, and what slides there turns towards an axis; turning the
// tangents changes the motion.
//   limit: rounds; 0 means 50. They end when no normal velocity changes by more than 1e-12 of max|b|. start is ignored.
// `solved` only if the answer also fits the cone; ConeResult::sweeps counts the rounds.
ConeResult solve_boxed(const ConeProblem& problem, const SolveOptions& options = {});

// Without friction: chapter 3's LCP of the normals alone, by Dantzig's method. mu is ignored.
ConeResult solve_frictionless(const ConeProblem& problem, const SolveOptions& options = {});

}  // namespace fc::friction

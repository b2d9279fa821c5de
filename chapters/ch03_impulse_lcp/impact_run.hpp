// A run on a scene with bodies and contacts: one impact, and what it does to the bodies.
#pragma once

#include "ch03_impulse_lcp/solver.hpp"
#include "common/program.hpp"

namespace fc::lcp {

// Resolves the impact of the scene's contacts, and writes the tables. Then throws SceneFailure if a solve failed.
int run_impact(const Scene& scene, const Solver& solve, const RunContext& context, Summary& summary);

}  // namespace fc::lcp

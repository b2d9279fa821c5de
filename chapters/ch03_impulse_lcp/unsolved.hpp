// A failed solve as a message to whoever wrote the scene.
#pragma once

#include "ch03_impulse_lcp/problem.hpp"
#include "common/scene.hpp"
#include "common/scene_failure.hpp"

namespace fc::lcp {

// The failure of the scene's solver in terms of the scene's keys: which key ended it, at what residual, and
// what to change.
//   status:   not solved.
//   pivots:   (or sweeps, or steps) when it ended; residual: that of problem.hpp, at that time.
SceneFailure unsolved(const SolverSpec& spec, Status status, int pivots, double residual);

// "pivots", "sweeps" or "steps": what a method's limit counts.
const char* counted_by(const std::string& method);

}  // namespace fc::lcp

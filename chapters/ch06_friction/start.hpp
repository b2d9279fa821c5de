// What every method of the chapter does first: check whether the problem is suited, and choose where to begin.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// Whether no method can help: then the result is filled in (r = 0, status unsuited or no_solution). Throws
// std::invalid_argument as solve() does.
bool refused(const ConeProblem& problem, const SolveOptions& options, ConeResult& result);

// The first r, with every contact in its cone. start: null means 0.
VecX start_in_cones(const ConeProblem& problem, const VecX* start);

}  // namespace fc::friction

// What every method of the chapter does first: look whether it may have the problem, and where to begin.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// Whether no method can help: fills the result (r = 0, status unsuited or no_solution) then. Throws
// std::invalid_argument as solve() does.
bool refused(const ConeProblem& problem, const SolveOptions& options, ConeResult& result);

// r to begin with, every contact in its cone. start: null means 0.
VecX start_in_cones(const ConeProblem& problem, const VecX* start);

}  // namespace fc::friction

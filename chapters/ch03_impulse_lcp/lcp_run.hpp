// A run on an LCP that the scene gives directly: a matrix and a vector, in the scene or in files.
#pragma once

#include "ch03_impulse_lcp/solver.hpp"
#include "common/program.hpp"

namespace fc::lcp {

// Throws InputError for files that cannot be read, and for sizes that do not fit.
void check_lcp(const LcpSpec& spec);

// Solves it, and writes the tables. Then throws SceneFailure if it was not solved.
int run_lcp(const LcpSpec& spec, const SolverSpec& solver, const Solver& solve, const RunContext& context,
            Summary& summary);

}  // namespace fc::lcp

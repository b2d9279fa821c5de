// What a run writes about a solve: solution.csv, solvers.csv, and their lines of the summary.
#pragma once

#include <cstdint>
#include <optional>

#include "ch03_impulse_lcp/solver.hpp"
#include "common/program.hpp"

namespace fc::lcp {

// A solve, and its time.
struct TimedResult {
  LcpResult lcp;
  std::int64_t ns = 0;
};

std::int64_t now_ns();

TimedResult solve_timed(const Lcp& problem, const Solver& solver);

// Writes both tables, with a row for every other method where the scene asks to compare.
//   solved: the result of the scene's own solver, spec.method.
void write_solution(const Lcp& problem, const TimedResult& solved, const SolverSpec& spec,
                    const RunContext& context, Summary& summary);

}  // namespace fc::lcp

// Dantzig's method takes nothing from the heap once its object has met problems as large (see dantzig.hpp).
#include <gtest/gtest.h>

#include <vector>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/problem_factory.hpp"
#include "tests/support/allocation_counter.hpp"

namespace fc::lcp {
namespace {

TEST(DantzigAllocation, ASolveTakesNothingFromTheHeap) {
  std::vector<KnownProblem> problems;
  for (const Family family : {Family::random_spd, Family::rank_deficient, Family::stack, Family::boxed,
                              Family::positive_definite, Family::degenerate}) {
    for (const Eigen::Index n : {16, 8, 4}) problems.push_back(make_problem(family, n, 1));
  }
  DantzigSolver solver;
  std::vector<LcpResult> results(problems.size());
  const auto solve_all = [&](bool guessed) {
    for (std::size_t k = 0; k < problems.size(); ++k) {
      solver.solve(problems[k].lcp(), {.start = guessed ? &problems[k].z : nullptr}, results[k]);
    }
  };
  solve_all(false);
  solve_all(true);
  const std::int64_t before = test::allocations();
  solve_all(false);
  solve_all(true);
  EXPECT_EQ(test::allocations() - before, 0);
  for (const LcpResult& result : results) EXPECT_EQ(result.status, Status::solved);
}

}  // namespace
}  // namespace fc::lcp

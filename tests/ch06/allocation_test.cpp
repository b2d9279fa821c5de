// A sweep of Gauss-Seidel takes nothing from the heap: a thousand of them as much as ten.
#include <gtest/gtest.h>

#include <random>

#include "ch06_friction/gauss_seidel.hpp"
#include "cones.hpp"
#include "tests/support/allocation_counter.hpp"

namespace fc::friction {
namespace {

TEST(GaussSeidelAllocation, ASweepTakesNothingFromTheHeap) {
  std::mt19937_64 random(20080101);
  OwnProblem p = random_problem(random, 12, 9, 0.5);  // redundant: it sweeps on and on
  for (Eigen::Index row = 0; row < p.b.size(); row += 3) p.b[row] = -std::abs(p.b[row]);
  const auto count = [&](int sweeps) {
    const std::int64_t before = test::allocations();
    const ConeResult result = solve_gauss_seidel(p, {.limit = sweeps, .tolerance = 1e-300});
    EXPECT_EQ(result.sweeps, sweeps);
    return test::allocations() - before;
  };
  EXPECT_EQ(count(10), count(1000));
}

}  // namespace
}  // namespace fc::friction

// The pivots that a student sees lead to the solver's answer.
#include "ch03_impulse_lcp/show_impulses.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "bodies.hpp"
#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/delassus.hpp"

namespace {

using namespace fc;
using namespace fc::lcp;

// Balls that fly at each other and at a wall, all touching at random points.
struct Heap {
  std::vector<RigidBody> bodies;
  std::vector<int> numbers;
  std::vector<Contact> contacts;
};
Heap heap(int seed, int contacts) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::uniform_real_distribution<double> real(-1, 1);
  Heap heap;
  heap.bodies.push_back(wall());
  for (int i = 0; i < 5; ++i)
    heap.bodies.push_back(box(3 * Vec3(real(random), real(random), real(random)),
                              Vec3(real(random), real(random), real(random))));
  heap.numbers.resize(heap.bodies.size());
  std::iota(heap.numbers.begin(), heap.numbers.end(), 10);
  for (int i = 0; i < contacts; ++i) {
    const int a = i % 5, b = a + 1 + static_cast<int>(random() % static_cast<unsigned>(5 - a));
    heap.contacts.push_back({a, b, 2 * Vec3(real(random), real(random), real(random)),
                             Vec3(real(random), real(random), real(random)).normalized(), 0, 0.5});
  }
  return heap;
}

TEST(ShownPivots, EndAtTheSolversAnswer) {
  int pivots_seen = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const Heap h = heap(seed, 3 + seed % 8);
    const ImpactProblem problem = assemble(h.bodies, h.contacts);
    const LcpResult solved = solve_dantzig({problem.A, problem.b});
    const std::vector<Pivot> pivots = pivots_of(problem.A, problem.b);
    ASSERT_FALSE(pivots.empty());
    EXPECT_TRUE(pivots.front().z.isZero(0));
    EXPECT_EQ(pivots.front().w, problem.b);
    const double size = problem.b.cwiseAbs().maxCoeff();
    EXPECT_LT((pivots.back().w - solved.w).cwiseAbs().maxCoeff(), 1e-9 * size);
    for (std::size_t k = 0; k < pivots.size(); ++k) {
      EXPECT_GE(pivots[k].z.minCoeff(), 0);
      EXPECT_LT((problem.A * pivots[k].z + problem.b - pivots[k].w).cwiseAbs().maxCoeff(), 1e-9 * size);
      if (k > 0) {
        EXPECT_NE(pivots[k].z, pivots[k - 1].z) << "a pivot that changes nothing";
      }
    }
    pivots_seen += static_cast<int>(pivots.size());
    const ShownContacts shown{h.bodies, h.numbers, h.contacts, 1};
    const auto steps = show_pivots(shown, problem.A, problem.b);
    ASSERT_EQ(steps.size(), pivots.size());
    for (std::size_t k = 0; k < steps.size(); ++k)
      for (std::size_t i = 0; i < h.contacts.size(); ++i)
        EXPECT_EQ(steps[k].bars->rows[i].value, pivots[k].z[static_cast<Eigen::Index>(i)]);
  }
  EXPECT_GT(pivots_seen, 200);
}

TEST(ShownImpact, ItsLastStepHasTheVelocitiesOfTheImpactLaw) {
  for (int seed = 0; seed < 30; ++seed) {
    const Heap h = heap(seed, 6);
    std::vector<RigidBody> after = h.bodies;
    const ImpactResult result = resolve_impact(after, h.contacts);
    ASSERT_EQ(result.status, Status::solved);
    const auto steps = show_impact({h.bodies, h.numbers, h.contacts, 1}, {}, "dantzig");
    if (result.solves == 0) continue;
    const algorithm::Bars& bars = *steps.back().bars;
    for (std::size_t i = 0; i < h.contacts.size(); ++i)
      EXPECT_NEAR(bars.rows[i].value, contact_velocity(after, h.contacts[i]), 1e-12);
  }
}

TEST(ShownImpact, NothingIsSolvedIfNothingApproaches) {
  Heap h = heap(1, 4);
  for (RigidBody& body : h.bodies) body.velocity.setZero();
  const auto steps = show_impact({h.bodies, h.numbers, h.contacts, 1}, {}, "dantzig");
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_NE(steps[0].text.find("nothing to solve"), std::string::npos);
}

}  // namespace

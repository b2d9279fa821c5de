// The impact law on cases with a closed form.
#include "ch03_impulse_lcp/impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "bodies.hpp"

namespace fc::lcp {
namespace {

constexpr double kRounding = 1e-14;

void expect_velocities(const std::vector<RigidBody>& bodies, const std::vector<double>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(bodies[i].velocity.x(), expected[i], kRounding) << "ball " << i;
  }
}

// v1' = ((m1 - e m2) v1 + (1 + e) m2 v2) / (m1 + m2), and the same with 1 and 2 exchanged.
TEST(Impact, OfTwoBallsHasTheTextbooksAnswer) {
  for (const double ratio : {1e-8, 0.5, 1.0, 3.0, 1e8}) {
    for (const double e : {0.0, 0.3, 1.0}) {
      const double m1 = ratio, m2 = 1, v1 = 2, v2 = -1;
      std::vector<RigidBody> bodies{ball({0, 0, 0}, {v1, 0, 0}, m1), ball({1, 0, 0}, {v2, 0, 0}, m2)};
      const ImpactResult result = resolve_impact(bodies, row_of_contacts(1, e));
      ASSERT_EQ(result.status, Status::solved);
      EXPECT_EQ(result.solves, 1);
      expect_velocities(bodies, {((m1 - e * m2) * v1 + (1 + e) * m2 * v2) / (m1 + m2),
                                 ((m2 - e * m1) * v2 + (1 + e) * m1 * v1) / (m1 + m2)});
      const double reduced = m1 * m2 / (m1 + m2), lost = -0.5 * (1 - e * e) * reduced * (v1 - v2) * (v1 - v2);
      EXPECT_NEAR(result.energy_identity, lost, 1e-13 * reduced);
    }
  }
}

TEST(Impact, OfABallOnAWallTurnsTheNormalVelocity) {
  std::vector<RigidBody> bodies{ball({0, 0, 0}, {3, 4, 0}), wall()};
  bodies[0].spin = {1, 2, 3};
  const ImpactResult result = resolve_impact(bodies, row_of_contacts(1, 0.5));
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_EQ(bodies[0].velocity, Vec3(-1.5, 4, 0));
  EXPECT_EQ(bodies[0].spin, Vec3(1, 2, 3));
  EXPECT_EQ(bodies[1].velocity, Vec3(0, 0, 0));
  ASSERT_EQ(result.impulses.size(), 1u);
  EXPECT_EQ(result.impulses[0].v_before, -3);
  EXPECT_EQ(result.impulses[0].v_after, 1.5);
  EXPECT_EQ(result.impulses[0].impulse, 4.5);
}

// n equal balls, one arrives, e = 1, all contacts at once: v1 = -(n - 2)/n, the others 2/n. The toy behaves
// differently; this is a known limit of the law, see the text.
TEST(Impact, OfNewtonsCradleSharesTheMomentum) {
  for (const int n : {2, 3, 4, 5, 10}) {
    std::vector<RigidBody> bodies{ball({0, 0, 0}, {1, 0, 0})};
    for (int i = 1; i < n; ++i) bodies.push_back(ball(Vec3(i, 0, 0), Vec3::Zero()));
    const ImpactResult result = resolve_impact(bodies, row_of_contacts(n - 1, 1));
    ASSERT_EQ(result.status, Status::solved);
    std::vector<double> expected(static_cast<std::size_t>(n), 2.0 / n);
    expected[0] = -(n - 2.0) / n;
    expect_velocities(bodies, expected);
    EXPECT_NEAR(result.energy_change, 0, kRounding);
  }
}

TEST(Impact, OfTwoBallsIntoThreeSharesTheMomentum) {
  std::vector<RigidBody> bodies;
  for (int i = 0; i < 5; ++i) bodies.push_back(ball(Vec3(i, 0, 0), Vec3(i < 2 ? 1 : 0, 0, 0)));
  resolve_impact(bodies, row_of_contacts(4, 1));
  expect_velocities(bodies, {-0.2, -0.2, 0.8, 0.8, 0.8});
}

TEST(Impact, IsSymmetric) {
  std::vector<RigidBody> bodies{ball({0, 0, 0}, {1, 0, 0}), ball({1, 0, 0}, {0, 0, 0}),
                                ball({2, 0, 0}, {-1, 0, 0})};
  resolve_impact(bodies, row_of_contacts(2, 1));
  expect_velocities(bodies, {-1, 0, 1});
}

// Both balls arrive at (2, 0): the one at the wall must not gain more than the other lost.
TEST(Impact, OfABallOnABallAtAWallKeepsTheEnergy) {
  std::vector<RigidBody> bodies{ball({0, 0, 0}, {2, 0, 0}), ball({1, 0, 0}, {0, 0, 0}), wall()};
  const ImpactResult result = resolve_impact(bodies, row_of_contacts(2, 1));
  expect_velocities(bodies, {-2, 0, 0});
  ASSERT_EQ(result.impulses.size(), 2u);
  EXPECT_NEAR(result.impulses[0].impulse, 4, kRounding);
  EXPECT_NEAR(result.impulses[1].impulse, 4, kRounding);
}

TEST(Impact, OfABoxOnItsCornersKeepsItLevel) {
  for (const int copies : {1, 8}) {  // four corners, and each of them eight times
    std::vector<RigidBody> bodies{wall(), box({0, 0, 0.5}, {0.25, 0, -2}, 2)};
    std::vector<Contact> contacts;
    for (int k = 0; k < copies; ++k) {
      for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) contacts.push_back({0, 1, {x, y, 0}, Vec3::UnitZ(), 0, 0.5});
      }
    }
    const ImpactResult result = resolve_impact(bodies, contacts);
    ASSERT_EQ(result.status, Status::solved);
    EXPECT_LE(result.worst_residual, 1e-14);
    EXPECT_LE((bodies[1].velocity - Vec3(0.25, 0, 1)).norm(), kRounding);
    EXPECT_LE(bodies[1].spin.norm(), kRounding);
    double sum = 0;
    for (const Impulse& p : result.impulses) sum += p.impulse;
    EXPECT_NEAR(sum, 6, 1e-13);  // m (1 + e) v
    EXPECT_NEAR(result.energy_change, -3, 1e-13);
  }
}

// The impulses that pass through the light box are 1e8 times what stops it alone, so its velocity keeps 8
// digits less: round-off times the mass ratio. What is left may separate, but must not approach.
TEST(Impact, OfAHeavyBoxOnALightOneStopsBoth) {
  for (const double mass : {1e-8, 1e-4, 1.0, 1e4, 1e8}) {
    std::vector<RigidBody> bodies{wall(), box({0, 0, 0.5}, {0, 0, 0}), box({0, 0, 1.5}, {0, 0, -1}, mass)};
    std::vector<Contact> contacts;
    for (const int k : {0, 1}) {
      for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) contacts.push_back({k, k + 1, Vec3(x, y, k), Vec3::UnitZ(), 0, 0});
      }
    }
    const ImpactResult result = resolve_impact(bodies, contacts);
    ASSERT_EQ(result.status, Status::solved);
    EXPECT_LE(result.worst_residual, 1e-13);
    EXPECT_LE(result.fastest_approach, 1e-12);
    const double rounding = 64 * 2.2e-16 * std::max(1.0, mass);
    EXPECT_NEAR(bodies[1].velocity.z(), 0, rounding) << mass;
    EXPECT_NEAR(bodies[2].velocity.z(), 0, rounding) << mass;
  }
}

bool same_bits(const RigidBody& p, const RigidBody& q) {
  return std::memcmp(p.velocity.data(), q.velocity.data(), sizeof(Vec3)) == 0 &&
         std::memcmp(p.spin.data(), q.spin.data(), sizeof(Vec3)) == 0;
}

TEST(Impact, WithoutApproachChangesNoBit) {
  std::vector<RigidBody> bodies{ball({0, 0, 0}, {-0.1, 0.3, 0}), ball({1, 0, 0}, {1.0 / 3, -0.7, 0})};
  bodies[0].spin = {0.1, 0.2, 0.3};
  const std::vector<RigidBody> before = bodies;
  const ImpactResult result = resolve_impact(bodies, row_of_contacts(1, 1));
  EXPECT_EQ(result.status, Status::solved);
  EXPECT_EQ(result.solves, 0);
  EXPECT_TRUE(result.impulses.empty());
  for (const std::size_t i : {0, 1}) EXPECT_TRUE(same_bits(bodies[i], before[i]));
}

// v = (0, 1, -1), e = 1: the contact that separated is pushed together with the other and ends approaching at
// its old speed of separation, so the instant is solved again.
TEST(Impact, IsSolvedAgainWhileSomethingApproaches) {
  std::vector<RigidBody> bodies{ball({0, 0, 0}, {0, 0, 0}), ball({1, 0, 0}, {1, 0, 0}),
                                ball({2, 0, 0}, {-1, 0, 0})};
  const ImpactResult result = resolve_impact(bodies, row_of_contacts(2, 1));
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_GE(result.solves, 2);
  EXPECT_LE(result.fastest_approach, approach_rounding(bodies, row_of_contacts(2, 1)));
  EXPECT_NEAR(result.energy_change, 0, kRounding);
  // Two solves are allowed: the last is made without restitution, and loses energy instead of going on.
  bodies = {ball({0, 0, 0}, {0, 0, 0}), ball({1, 0, 0}, {1, 0, 0}), ball({2, 0, 0}, {-1, 0, 0})};
  const ImpactResult two = resolve_impact(bodies, row_of_contacts(2, 1), {.max_solves = 2, .solver = {}});
  ASSERT_EQ(two.status, Status::solved);
  EXPECT_EQ(two.solves, 2);
  EXPECT_LE(two.fastest_approach, 1e-12);
  EXPECT_NEAR(two.energy_change, two.energy_identity, kRounding);
}

// e = (0, 1), v = (0, 1, -1): the law gives (-2/3, -2/3, 4/3), one third more energy than before. By design:
// see the text.
TEST(Impact, MixedRestitutionMayGainEnergy) {
  std::vector<RigidBody> bodies{ball({0, 0, 0}, {0, 0, 0}), ball({1, 0, 0}, {1, 0, 0}),
                                ball({2, 0, 0}, {-1, 0, 0})};
  std::vector<Contact> contacts = row_of_contacts(2, 1);
  contacts[0].restitution = 0;
  const ImpactResult result = resolve_impact(bodies, contacts);
  ASSERT_EQ(result.status, Status::solved);
  expect_velocities(bodies, {-2.0 / 3, -2.0 / 3, 4.0 / 3});
  EXPECT_NEAR(result.energy_change, 1.0 / 3, kRounding);
  EXPECT_NEAR(result.energy_identity, 1.0 / 3, kRounding);
  EXPECT_FALSE(result.restitution_lowered);
}

// A ball between two walls, e = 1 on the left and 0 on the right, flying right: leaving the right wall asks
// w2 >= 0 and being held by the left one w1 >= 0, with w1 + w2 = 2 v1 + v2 < 0 when it flies left. Impulses
// cannot change the sum.
TEST(Impact, MixedRestitutionWithoutSolutionFallsBackToTheSmallest) {
  std::vector<RigidBody> bodies{wall(), ball({0, 0, 0}, {-1, 0, 0}), wall()};
  const std::vector<Contact> contacts{{0, 1, {-0.5, 0, 0}, Vec3::UnitX(), 0, 1},
                                      {1, 2, {0.5, 0, 0}, Vec3::UnitX(), 0, 0}};
  const ImpactResult result = resolve_impact(bodies, contacts);
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_TRUE(result.restitution_lowered);
  EXPECT_NEAR(bodies[1].velocity.x(), 0, kRounding);
}

TEST(Impact, ThatFailsLeavesTheBodiesAlone) {
  std::vector<RigidBody> bodies{ball({0, 0, 0}, {1, 0, 0}), ball({1, 0, 0}, {0, 0, 0})};
  const std::vector<RigidBody> before = bodies;
  const auto wrong = [](const Lcp& problem) {  // claims to have solved it
    LcpResult result{Status::solved, VecX::Constant(problem.size(), 0.1), VecX(), 0, 0};
    result.w = evaluate(problem.A, problem.b, result.z);
    return result;
  };
  const ImpactResult result =
      resolve_impact(bodies, row_of_contacts(1, 1), {.max_solves = 8, .solver = wrong});
  EXPECT_EQ(result.status, Status::limit);
  EXPECT_TRUE(result.impulses.empty());
  for (const std::size_t i : {0, 1}) EXPECT_TRUE(same_bits(bodies[i], before[i]));
}

TEST(Impact, RefusesCallersMistakes) {
  std::vector<RigidBody> bodies{ball({0, 0, 0}, {1, 0, 0}), ball({1, 0, 0}, {0, 0, 0})};
  EXPECT_THROW(resolve_impact(bodies, row_of_contacts(2, 1)), std::invalid_argument);
  EXPECT_THROW(resolve_impact(bodies, row_of_contacts(1, 1), {.max_solves = 1, .solver = {}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace fc::lcp

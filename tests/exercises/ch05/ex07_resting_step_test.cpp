// Exercise 5.7. Closed forms: a box alone, a stack, what turns. Then islands at random, by the three conditions that say what
// velocities and paths are; their answer is the only one.
#include "ex07_resting_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "ch03_impulse_lcp/solver.hpp"

namespace {

using fc::MatX;
using fc::RigidBody;
using fc::Vec3;
using fc::VecX;
using fc::mine::RestingProblem;
using fc::mine::RestingResult;
using fc::mine::RestingRow;

constexpr double kGravity = 10, kLength = 0.02, kRest = 2.5e-4;  // m/s^2, s, m

bool dantzig(const MatX& A, const VecX& b, VecX& z) {
  const fc::lcp::LcpResult result = fc::lcp::solve({A, b});
  if (result.status != fc::lcp::Status::solved) return false;
  z = result.z;
  return true;
}

RestingResult step(const RestingProblem& island) {
  return fc::mine::resting_step(island, dantzig);
}

RigidBody box(double height, double mass = 2, double velocity = 0) {
  RigidBody body;
  body.position = {0, 0, height};
  body.velocity = {0, 0, velocity};
  body.set_mass(fc::box_mass({1, 1, 1}, mass));
  return body;
}

// A floor at 0, and bodies one above the other, 1 m each, with these gaps below them; gravity pulls.
RestingProblem column(const std::vector<double>& gaps, const std::vector<double>& masses) {
  RestingProblem island;
  island.length = kLength;
  island.rest_gap = kRest;
  island.bodies.emplace_back();
  island.gravity.push_back(Vec3::Zero());
  double height = 0.5;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    height += gaps[k];
    island.bodies.push_back(box(height, masses[k]));
    island.gravity.push_back({0, 0, -kGravity});
    RestingRow row;
    row.contact = {
        static_cast<int>(k), static_cast<int>(k) + 1, {0, 0, height - 0.5}, Vec3::UnitZ(), gaps[k]};
    island.rows.push_back(row);
    height += 1;
  }
  return island;
}
RestingProblem one(double gap, double velocity = 0) {
  RestingProblem island = column({gap}, {2});
  island.bodies[1].velocity.z() = velocity;
  return island;
}
double gap_at_end(const RestingProblem& island, const RestingResult& result, int row = 0) {
  const RestingRow& r = island.rows[static_cast<std::size_t>(row)];
  return r.contact.gap + island.length * fc::lcp::contact_velocity(result.y, r.contact) + r.bend;
}

TEST(Ex07RestingStep, AtRestHalfOfTheWeight) {
  const RestingProblem island = one(kRest);
  const RestingResult result = step(island);
  ASSERT_TRUE(result.solved);
  ASSERT_EQ(result.z.size(), 1) << "an impulse for each row";
  EXPECT_NEAR(result.z[0], 0.5 * 2 * kGravity * kLength, 1e-14)
      << "N s: half of the weight's impulse. The other half comes at the plan's end, with the other half of gravity; twice "
         "as much means that all of gravity came first";
  EXPECT_NEAR(result.w[1].velocity.z(), 0, 1e-15) << "m/s: a box at the rest gap stands";
  EXPECT_NEAR(result.y[1].velocity.z(), 0, 1e-15) << "m/s, on its path: nothing is to be put right";
  EXPECT_EQ(result.w[1].position, island.bodies[1].position) << "bodies are returned where they are now";
}

TEST(Ex07RestingStep, WithoutContactsHalfOfGravity) {
  RestingProblem island = one(0.1, 3);
  island.rows.clear();
  island.bodies[1].spin = {1, 2, 3};
  const RestingResult result = step(island);
  ASSERT_TRUE(result.solved) << "nothing to solve is no failure";
  for (const RigidBody& body : {result.w[1], result.y[1]}) {
    EXPECT_NEAR(body.velocity.z(), 3 - 0.5 * kGravity * kLength, 1e-14)
        << "m/s: the mean velocity of free flight";
    EXPECT_EQ(body.spin, Vec3(1, 2, 3)) << "rad/s: gravity turns nothing";
  }
  EXPECT_EQ(result.w[0].velocity, Vec3::Zero()) << "m/s: the floor has no gravity";
}

TEST(Ex07RestingStep, AWideGapMayShrinkToTheRestGap) {
  const double gap = 1.6 * kRest;
  RestingProblem island = one(gap, -0.05);
  RestingResult result = step(island);
  ASSERT_TRUE(result.solved);
  EXPECT_NEAR(result.w[1].velocity.z(), (kRest - gap) / kLength, 1e-14)
      << "m/s: it may use up what the gap has above h/2, in the plan's time, and no more";
  island.bodies[1].velocity.z() = 0.1;
  result = step(island);
  EXPECT_EQ(result.z[0], 0) << "N s: what parts fast enough is not pushed";
}

TEST(Ex07RestingStep, ANarrowGapGivesNoVelocity) {
  const RestingResult result = step(one(0.8 * kRest));
  ASSERT_TRUE(result.solved);
  EXPECT_NEAR(result.w[1].velocity.z(), 0, 1e-15)
      << "m/s: a gap that is too narrow is an error of place. A velocity that mends it is kinetic energy out of nothing, and "
         "the body keeps it";
  EXPECT_NEAR(result.z[0], 0.5 * 2 * kGravity * kLength, 1e-14)
      << "N s: the weight's half, and nothing for the gap";
}

TEST(Ex07RestingStep, ThePathPutsTheGapRight) {
  RestingProblem island = one(0.8 * kRest);
  RestingResult result = step(island);
  EXPECT_NEAR(gap_at_end(island, result), 0.84 * kRest, 1e-15)
      << "m: on its path a gap of 0.8 h/2 comes nearer to h/2 by a fifth of what it lacks";
  EXPECT_NEAR(result.c[0], 2 * 0.04 * kRest / kLength, 1e-15)
      << "N s, that only the path feels: mass times its velocity";
  island = one(0);
  result = step(island);
  EXPECT_NEAR(gap_at_end(island, result), 0.5 * kRest, 1e-15) << "m: what touches is put at h/4 at once";
  island = one(0.8 * kRest, 1);
  result = step(island);
  EXPECT_EQ(result.c[0], 0) << "N s: what parts fast needs no correction, however narrow its gap is now";
}

TEST(Ex07RestingStep, AStackCarriesItsWeight) {
  const std::vector<double> masses{3, 1, 4, 1, 5, 9, 2, 6};
  RestingProblem island = column(std::vector<double>(8, kRest), masses);
  const RestingResult result = step(island);
  ASSERT_TRUE(result.solved);
  double above = 0;
  for (int k = 7; k >= 0; --k) {
    above += masses[static_cast<std::size_t>(k)];
    EXPECT_NEAR(result.z[k], 0.5 * above * kGravity * kLength, 1e-12)
        << "N s under box " << k
        << ": half of the impulse of the weight above it. The rows have to be solved together";
  }
}

TEST(Ex07RestingStep, CorrectionsAreSolvedTogether) {
  // The lower gap lacks 0.2 h/2; the upper one is right. The upper box has to be lifted, too.
  RestingProblem island = column({0.8 * kRest, kRest}, {1, 1});
  const RestingResult result = step(island);
  EXPECT_NEAR(gap_at_end(island, result, 0), 0.84 * kRest, 1e-15) << "m, the lower gap";
  EXPECT_NEAR(gap_at_end(island, result, 1), kRest, 1e-15)
      << "m, the upper gap: its box goes up with the lower one";
  EXPECT_NEAR(result.w[2].velocity.z(), 0, 1e-14) << "m/s: and has no velocity from that";
}

TEST(Ex07RestingStep, TheBendBelongsToTheGap) {
  RestingProblem island = one(kRest);
  island.rows[0].bend = -0.3 * kRest;  // its body turns: that uses up so much of the gap
  RestingResult result = step(island);
  EXPECT_NEAR(result.w[1].velocity.z(), 0.3 * kRest / kLength, 1e-14)
      << "m/s: so that the gap at the END is h/2, the box has to part now";
  EXPECT_NEAR(gap_at_end(island, result), kRest, 1e-15) << "m, the bend counted in";
  island.rows[0].bend = 0.3 * kRest;
  result = step(island);
  EXPECT_NEAR(result.w[1].velocity.z(), -0.3 * kRest / kLength, 1e-14) << "m/s: a bend that opens gives room";
}

TEST(Ex07RestingStep, NothingPartsFasterThanTheEndTakesBack) {
  RestingProblem island = one(kRest);
  island.rows[0].bend = -0.3 * kRest;
  island.rows[0].end_speed = 0.1 * kRest / kLength;
  const RestingResult result = step(island);
  EXPECT_NEAR(result.w[1].velocity.z(), island.rows[0].end_speed, 1e-14)
      << "m/s: a push may let a point part only as fast as the point closes at the end (end_speed); more would be energy "
         "out of nothing";
  EXPECT_NEAR(gap_at_end(island, result), kRest, 1e-15)
      << "m: what velocities may not do, the path does; it has no such limit, since nobody keeps its velocity";
}

TEST(Ex07RestingStep, ALiftThatMoves) {
  RestingProblem island = one(kRest);
  island.bodies[0].velocity = {0, 0, 0.5};  // kinematic: nothing moves it, and it goes up
  const RestingResult result = step(island);
  EXPECT_NEAR(result.w[1].velocity.z(), 0.5, 1e-14) << "m/s: the box goes up with the lift";
  EXPECT_EQ(result.w[0].velocity, Vec3(0, 0, 0.5)) << "m/s: the lift is not slowed down";
}

TEST(Ex07RestingStep, OffTheCentreItTurns) {
  RestingProblem island = one(kRest);
  island.rows[0].contact.point = {0.5, 0, kRest};
  const RestingResult result = step(island);
  ASSERT_TRUE(result.solved);
  EXPECT_NEAR(fc::lcp::contact_velocity(result.w, island.rows[0].contact), 0, 1e-14)
      << "m/s, of the point: the point keeps its gap, not the centre";
  // 1/m + r^2/I = 1/2 + 1/4 / (1/3) = 5/4 per kg.
  EXPECT_NEAR(result.z[0], 0.5 * kGravity * kLength / 1.25, 1e-14)
      << "N s: the box turns away, and seems light";
  EXPECT_NEAR(result.w[1].spin.norm(), result.z[0] * 0.5 * 3, 1e-14) << "rad/s";
}

TEST(Ex07RestingStep, WhatHasNoAnswer) {
  // A kinematic plate comes down on a box that stands on the floor.
  RestingProblem island = one(kRest);
  island.bodies.push_back({});
  island.bodies[2].position = {0, 0, 2};
  island.bodies[2].velocity = {0, 0, -1};
  island.gravity.push_back(Vec3::Zero());
  RestingRow above;
  above.contact = {1, 2, {0, 0, 1 + kRest}, Vec3::UnitZ(), kRest};
  island.rows.push_back(above);
  EXPECT_FALSE(step(island).solved) << "no impulses keep both gaps open: that is to be told";

  // The plate stands still, and there is no room above: gaps stay as they are, which is no failure.
  island.bodies[2].velocity.setZero();
  for (RestingRow& row : island.rows) row.contact.gap = 0.4 * kRest;
  const RestingResult result = step(island);
  ASSERT_TRUE(result.solved) << "the velocities have an answer: the box stands";
  EXPECT_NEAR(result.w[1].velocity.norm(), 0, 1e-15) << "m/s";
  EXPECT_NEAR(result.y[1].velocity.norm(), 0, 1e-15)
      << "m/s: both gaps cannot grow, so the path makes no correction";
  ASSERT_EQ(result.c.size(), 2);
  EXPECT_EQ(result.c.norm(), 0) << "N s";
}

// Boxes of random shapes, each with some contacts with those before; body 0 is fixed.
RestingProblem random_island(unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(engine), any(engine), any(engine)); };
  RestingProblem island;
  island.length = kLength;
  island.rest_gap = kRest;
  for (int k = 0; k < 7; ++k) {
    RigidBody body;
    body.position = Vec3(0, 0, k) + 0.3 * vector();
    if (k > 0) {
      body.orientation = Eigen::AngleAxisd(3 * any(engine), vector().normalized());
      body.set_mass(fc::box_mass(Vec3::Constant(1) + 0.6 * vector(), 1 + 0.7 * any(engine)));
      body.velocity = 0.05 * vector();
      body.spin = 0.05 * vector();
    }
    island.bodies.push_back(body);
    island.gravity.push_back(k > 0 ? Vec3(1, 0, -kGravity) : Vec3(Vec3::Zero()));
    for (int i = 0; k > 0 && i < 2; ++i) {
      RestingRow row;
      row.contact = {k - 1 - (k > 1 && i == 1), k, body.position + 0.5 * vector() - Vec3(0, 0, 0.5),
                     (0.4 * vector() + Vec3::UnitZ()).normalized(), kRest * (1 + any(engine))};
      row.bend = 0.2 * kRest * any(engine);
      if (any(engine) > 0) row.end_speed = 0.1 * kRest / kLength * (1 + any(engine));
      island.rows.push_back(row);
    }
  }
  return island;
}

TEST(Ex07RestingStep, RandomIslands) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "island " << seed);
    const RestingProblem island = random_island(seed);
    const RestingResult result = step(island);
    ASSERT_TRUE(result.solved);
    Vec3 momentum = Vec3::Zero(), impulses = Vec3::Zero();
    for (std::size_t k = 1; k < island.bodies.size(); ++k) {
      const Vec3 change =
          result.w[k].velocity - island.bodies[k].velocity - 0.5 * kLength * island.gravity[k];
      momentum += island.bodies[k].mass * change;
    }
    for (std::size_t i = 0; i < island.rows.size(); ++i) {
      const RestingRow& row = island.rows[i];
      const auto n = static_cast<Eigen::Index>(i);
      const double gap = row.contact.gap, keep = std::min(gap, kRest),
                   want = std::max(keep + 0.2 * (kRest - keep), 0.5 * kRest);
      const double left = fc::lcp::contact_velocity(result.w, row.contact) +
                          std::max((gap + row.bend - keep) / kLength, -row.end_speed);
      const double left_on_path =
          fc::lcp::contact_velocity(result.y, row.contact) + (gap + row.bend - want) / kLength;
      EXPECT_GE(result.z[n], 0) << "N s, row " << i << ": a contact does not pull";
      EXPECT_GE(left, -1e-12) << "m/s, row " << i << ": closes by so much faster than it may";
      EXPECT_NEAR(result.z[n] * left, 0, 1e-12)
          << "row " << i << ": pushed, although it closes with less than it may";
      EXPECT_GE(left_on_path, -1e-12)
          << "m/s, row " << i << ": on the path it closes by so much faster than it may";
      EXPECT_NEAR(result.c[n] * left_on_path, 0, 1e-12) << "row " << i << ": corrected more than is needed";
      if (row.contact.body_a == 0) impulses += result.z[n] * row.contact.normal;
    }
    EXPECT_NEAR((momentum - impulses).norm(), 0, 1e-12)
        << "N s: what all bodies gain is what the floor gives; between two bodies it cancels";
  }
}

}  // namespace

// What must not matter: the frame's length, the direction of time, left and right. And flights without
// collisions.
#include <gtest/gtest.h>

#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Quat, fc::Vec3;

TEST(FreeFlight, KeepsSpinAndMomentumToTheBit) {
  auto world = make_world(balls + "  - {shape: brick, velocity: [1, 2, 3], spin: [3, -4, 12]}\n");
  const fc::RigidBody start = body(world, 0);
  run_world(world, 1.0 / 64, 128);
  const fc::RigidBody& end = body(world, 0);
  EXPECT_EQ(end.spin, start.spin);
  EXPECT_EQ(end.velocity, start.velocity);
  EXPECT_EQ(end.momentum(), start.momentum());
  EXPECT_LE((end.position - Vec3(2, 4, 6)).norm(), 1e-13);
  const Quat turn(Eigen::AngleAxisd(2 * 13.0, Vec3(3, -4, 12) / 13));
  EXPECT_LE(end.orientation.angularDistance(turn * start.orientation), 1e-12);
}

// Stated by the text: without a gyroscopic effect the spin is constant, so the angular momentum of a brick
// that spins about no principal axis turns with it.
TEST(FreeFlight, TurnsTheAngularMomentumOfABrick) {
  auto world = make_world(
      balls +
      "  - {shape: brick, spin: [1, 1, 1]}\n  - {shape: brick, position: [9, 0, 0], spin: [0, 0, 2]}\n");
  const Vec3 before = body(world, 0).angular_momentum(), principal = body(world, 1).angular_momentum();
  run_world(world, 0.1, 10);
  EXPECT_GT((body(world, 0).angular_momentum() - before).norm(), 0.01 * before.norm());
  EXPECT_LE((body(world, 1).angular_momentum() - principal).norm(), 1e-14);
}

const std::string billiard = balls + R"(
  - {shape: wall, static: true, position: [-2.5, 0, 0]}
  - {shape: ball, position: [-1, 0.1, 0], velocity: [3, 0, 0.1]}
  - {shape: heavy, position: [1, -0.2, 0.1], velocity: [-2, 0.1, 0]}
  - {shape: wall, static: true, position: [3, 0, 0]}
  - {shape: brick, position: [0.4, 1.4, 0.1], orientation: [0.9, 0.3, 0.1, 0.2], velocity: [0, -1, 0], spin: [0.5, 0.2, -1]}
)";

TEST(FrameLength, DoesNotChangeTheImpacts) {
  std::vector<Events> runs;
  for (const int rate : {60, 240, 7}) {
    auto world = make_world(billiard);
    runs.push_back(run_world(world, 1.0 / rate, 2 * rate));
    EXPECT_EQ(runs.back().lost_time(), 0);
  }
  ASSERT_GE(runs[0].all.size(), 4U);
  for (std::size_t run : {1, 2}) {
    ASSERT_EQ(runs[run].all.size(), runs[0].all.size());
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(runs[run].all[k].t, runs[0].all[k].t, 1e-7) << k;
      EXPECT_NEAR(runs[run].all[k].impulse.impulse, runs[0].all[k].impulse.impulse, 1e-6) << k;
      EXPECT_LE((runs[run].all[k].contact.point - runs[0].all[k].contact.point).norm(), 1e-6) << k;
    }
  }
}

TEST(Time, RunsBackwardsWithoutLosses) {
  auto world = make_world(billiard);
  const auto start = world.bodies;
  const Events there = run_world(world, 1.0 / 60, 90);
  EXPECT_GE(there.all.size(), 3U);
  EXPECT_GT((body(world, 1).position - start[1].state.position).norm(), 0.1);
  for (auto& b : world.bodies) b.state.velocity *= -1, b.state.spin *= -1;
  const Events back = run_world(world, 1.0 / 60, 90);
  EXPECT_EQ(back.all.size(), there.all.size());
  for (std::size_t i = 0; i < start.size(); ++i) {
    EXPECT_LE((body(world, i).position - start[i].state.position).norm(), 1e-5) << i;
    EXPECT_LE((body(world, i).velocity + start[i].state.velocity).norm(), 1e-5) << i;
    EXPECT_LE(body(world, i).orientation.angularDistance(start[i].state.orientation), 1e-5) << i;
  }
}

TEST(Mirror, ShowsTheSameWorld) {
  auto world = make_world(billiard), mirrored = make_world(billiard);
  for (auto& b : mirrored.bodies) {  // y -> -y: spins and quaternions keep their y
    b.state.position.y() *= -1;
    b.state.velocity.y() *= -1;
    b.state.spin = Vec3(-b.state.spin.x(), b.state.spin.y(), -b.state.spin.z());
    const Quat q = b.state.orientation;
    b.state.orientation = Quat(q.w(), -q.x(), q.y(), -q.z());
  }
  const Events one = run_world(world, 1.0 / 60, 90), other = run_world(mirrored, 1.0 / 60, 90);
  ASSERT_GE(one.all.size(), 3U);
  ASSERT_EQ(one.all.size(), other.all.size());
  for (std::size_t k = 0; k < one.all.size(); ++k) EXPECT_NEAR(one.all[k].t, other.all[k].t, 1e-7);
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Vec3 &x = body(world, i).position, &y = body(mirrored, i).position;
    EXPECT_LE((x - Vec3(y.x(), -y.y(), y.z())).norm(), 1e-5) << i;
  }
}

// Two hits of one billiard, far away from the origin: the world has no middle.
TEST(Place, DoesNotMatter) {
  auto here = make_world(billiard), there = make_world(billiard);
  const Vec3 shift(64, -128, 32);
  for (auto& b : there.bodies) b.state.position += shift;
  const Events one = run_world(here, 1.0 / 60, 60), other = run_world(there, 1.0 / 60, 60);
  ASSERT_EQ(one.all.size(), other.all.size());
  for (std::size_t k = 0; k < one.all.size(); ++k) EXPECT_NEAR(one.all[k].t, other.all[k].t, 1e-7);
}

TEST(Step, RefusesALengthThatIsNone) {
  auto world = make_world(billiard);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double dt : {0.0, -0.1, nan, inf}) {
    EXPECT_THROW(fc::world::step(world, dt), std::invalid_argument) << dt;
    EXPECT_EQ(body(world, 1).position, Vec3(-1, 0.1, 0)) << "nothing moved";
  }
}

}  // namespace

// Falling, bouncing, coming to rest as far as this chapter can.
#include <gtest/gtest.h>

#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

constexpr double g = 9.81;
const std::string falling =
    "gravity: [0, 0, -9.81]" + balls + "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n";

TEST(FreeFall, IsExact) {
  auto world = make_world("gravity: [0.5, 0, -9.81]" + balls +
                          "  - {shape: ball, velocity: [1, 2, 3], spin: [0, 0, 7]}\n");
  run_world(world, 1.0 / 60, 120);
  EXPECT_LE((body(world, 0).position - Vec3(2 + 1, 4, 6 - 2 * g)).norm(), 1e-12);
  EXPECT_LE((body(world, 0).velocity - Vec3(2, 2, 3 - 2 * g)).norm(), 1e-12);
}

TEST(Bounces, OfABallOnAFloor) {
  const double e = 0.8, height = 1, first = std::sqrt(2 * height / g);
  auto world = make_world(falling + "  - {shape: ball, position: [0, 0, 1.5]}\n", {"restitution=0.8"});
  const double start = energy(world);
  const Events events = run_world(world, 1.0 / 60, 180);  // the bounces pile up at t = 4.06 s only
  ASSERT_GE(events.all.size(), 5U);
  double t = first, speed = g * first;
  for (std::size_t k = 0; k < events.all.size(); ++k) {
    EXPECT_NEAR(events.all[k].t, t, k == 0 ? 1e-9 : 1e-8) << k;
    EXPECT_NEAR(events.all[k].impulse.v_before, -speed, 1e-8);
    EXPECT_NEAR(events.all[k].impulse.v_after, e * speed, 1e-8);
    speed *= e;
    t += 2 * speed / g;
  }
  EXPECT_GT(t, 3.0) << "none is missing";
  EXPECT_LE(events.all[0].t, first) << "never late";
  EXPECT_NEAR(energy(world) - 0.5 * g,
              (start - 0.5 * g) * std::pow(e, 2.0 * static_cast<double>(events.all.size())), 1e-7);
  EXPECT_EQ(events.lost_time(), 0);
}

TEST(Bounces, AtRestitutionOneKeepTheEnergy) {
  auto world = make_world(falling + "  - {shape: ball, position: [0, 0, 1.5], velocity: [0.3, 0, 0]}\n");
  const double start = energy(world);
  const Events events = run_world(world, 1.0 / 60, 240);
  EXPECT_EQ(events.all.size(), 4U);  // at 0.45 s, then every 0.90 s
  EXPECT_NEAR(energy(world), start, 1e-9);
}

// The heights shrink as powers of e^2, the bounces end at t1 (1 + e)/(1 - e) = 1.354 s; after that the ball
// is frozen.
TEST(Bounces, ThatPileUpAreReportedAsLostTime) {
  const double first = std::sqrt(2 / g), end = 3 * first;
  auto world = make_world(falling + "  - {shape: ball, position: [0, 0, 1.5]}\n",
                          {"restitution=0.5", "ccd.tolerance=1e-6"});
  double before = energy(world);
  for (int frame = 0; frame < 120; ++frame) {
    const auto report = fc::world::step(world, 1.0 / 60);
    EXPECT_LE(energy(world), before + 1e-12);
    before = energy(world);
    EXPECT_GT(body(world, 1).position.z(), 0.5) << frame;
    EXPECT_EQ(report.max_penetration, 0);
    if ((frame + 1) / 60.0 < end - 0.02) {
      EXPECT_EQ(report.lost_time, 0) << frame;
    }
    if (frame / 60.0 > end + 0.02) {
      EXPECT_GT(report.lost_time, 0) << frame;
      EXPECT_LE(body(world, 1).position.z(), 0.5 + 2e-5);
    }
  }
}

TEST(Landing, WithoutRestitutionStopsAndIsFrozen) {
  auto world = make_world(falling + "  - {shape: brick, position: [0, 0, 0.5], velocity: [0.2, 0, 0]}\n",
                          {"restitution=0", "ccd.tolerance=1e-6"});
  const Events events = run_world(world, 1.0 / 60, 60);
  const double t = std::sqrt(2 * 0.2 / g);
  ASSERT_GE(events.all.size(), 3U);
  EXPECT_NEAR(events.all[0].t, t, 1e-6);
  EXPECT_NEAR(events.all[0].impulse.v_before, -g * t, 1e-5);
  EXPECT_NEAR(events.all[0].impulse.v_after, 0, 1e-12);
  EXPECT_GT(events.lost_time(), 0);
  EXPECT_GT(body(world, 1).position.z(), 0.3);
  EXPECT_LE(body(world, 1).position.z(), 0.3 + 2e-6);
  EXPECT_NEAR(body(world, 1).velocity.x(), 0.2, 1e-12) << "kept";
  EXPECT_NEAR(body(world, 1).velocity.z(), 0, 0.2);
}

TEST(Resting, AStackUnderGravityIsFrozenAndNeverSinks) {
  std::string text = falling;
  for (const char* z : {"0.3", "0.9", "1.5"})
    text += std::string("  - {shape: brick, position: [0, 0, ") + z + "]}\n";
  auto world = make_world(text, {"restitution=0.5", "ccd.tolerance=1e-6"});
  const double start = energy(world);
  const Events events = run_world(world, 1.0 / 60, 30);
  EXPECT_GT(events.lost_time(), 0);
  EXPECT_LE(energy(world), start + 1e-12);
  for (int i = 1; i <= 3; ++i) {
    EXPECT_NEAR(body(world, i).position.z(), 0.6 * i - 0.3, 1e-6);
    if (i > 1) {
      EXPECT_GE(body(world, i).position.z() - body(world, i - 1).position.z(), 0.6 - 1e-12);
    }
  }
  EXPECT_GE(body(world, 1).position.z(), 0.3 - 1e-12);
  expect_sound(events);
}

TEST(Resting, WithoutGravityAStackDoesNotMove) {
  std::string text = balls + "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n";
  for (const char* z : {"0.3", "0.9", "1.5"})
    text += std::string("  - {shape: brick, position: [0, 0, ") + z + "]}\n";
  auto world = make_world(text);
  const auto before = world.bodies;
  const Events events = run_world(world, 1.0 / 60, 30);
  EXPECT_TRUE(events.all.empty());
  EXPECT_EQ(events.lost_time(), 0);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(body(world, i).position, before[i].state.position);
    EXPECT_EQ(body(world, i).orientation.coeffs(), before[i].state.orientation.coeffs());
  }
}

TEST(Sliding, AlongATouchingFloorIsNotHeldUp) {
  for (const char* z : {"0.3", "0.3000005", "0.300003"}) {
    auto world = make_world(
        balls +
            "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n  - {shape: brick, position: [0, 0, " +
            z + "], velocity: [1, 0.5, 0]}\n",
        {"ccd.tolerance=1e-6"});
    const Events events = run_world(world, 1.0 / 60, 60);
    EXPECT_EQ(events.lost_time(), 0) << z;
    EXPECT_TRUE(events.all.empty()) << z;
    EXPECT_LE((body(world, 1).position - Vec3(1, 0.5, std::stod(z))).norm(), 1e-12) << z;
  }
}

TEST(Spinning, BallInContactIsNotHeldUp) {
  auto world = make_world(balls +
                          "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
                          "  - {shape: ball, position: [0, 0, 0.5], velocity: [1, 0, 0], spin: [3, 4, 5]}\n");
  const Events events = run_world(world, 1.0 / 60, 60);
  EXPECT_EQ(events.lost_time(), 0);
  EXPECT_LE((body(world, 1).position - Vec3(1, 0, 0.5)).norm(), 1e-12);
}

// Three balls at a small restitution collapse: infinitely many impacts in a finite time. No hang, no overlap.
TEST(InelasticCollapse, EndsAndStaysApart) {
  auto world =
      make_world(balls +
                     "  - {shape: ball, velocity: [1, 0, 0]}\n  - {shape: ball, position: [1.1, 0, 0]}\n"
                     "  - {shape: ball, position: [2.2, 0, 0], velocity: [-1, 0, 0]}\n",
                 {"restitution=0.03", "bodies.1.velocity=[0.1, 0, 0]"});
  double before = kinetic_energy(world);
  for (int frame = 0; frame < 60; ++frame) {
    fc::world::step(world, 1.0 / 60);
    EXPECT_LE(kinetic_energy(world), before + 1e-13);
    before = kinetic_energy(world);
    for (int i : {1, 2}) EXPECT_GT((body(world, i).position - body(world, i - 1).position).norm(), 1);
  }
  EXPECT_NEAR(body(world, 0).velocity.x() + body(world, 1).velocity.x() + body(world, 2).velocity.x(), 0.1,
              1e-12);
}

}  // namespace

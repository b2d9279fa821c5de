// Impacts on resting bodies, and kinematic bodies that run into others.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "oracles.hpp"

namespace {

using namespace fc_test;

// A kinematic plate pushes two boxes against a wall, which is impossible: no box is run through, neither by the exact
// solution nor in a pile, and the plate's work is reported.
TEST(KinematicBody, APlateThatCannotGoOnIsStopped) {
  for (const double most_work : {2e5, 0.0}) {
    Simulation s(
        "step: {dt: 0.01, duration: 1}\nenvelope: 5.0e-4\nshapes:\n"
        "  box: {box: {size: [1, 1, 1]}, mass: 2}\nbodies:\n"
        "  - {shape: box, kinematic: true, position: [-1.5, 0, 0], velocity: [1, 0, 0]}\n"
        "  - {shape: box, position: [0, 0, 0]}\n  - {shape: box, position: [1.2, 0, 0]}\n"
        "  - {shape: box, static: true, position: [3, 0, 0]}\n",
        1 / 60.0, {.most_work = most_work});
    double work = 0;
    for (int frame = 0; frame < 180; ++frame) {
      s.run(1 / 60.0);
      work += s.last.step.kinematic_work;
      for (int body = 0; body < 3; ++body)
        ASSERT_GT(s.body(body + 1).position.x() - s.body(body).position.x(), 1)
            << most_work << ", frame " << frame;
    }
    EXPECT_GT(s.smallest_gap, 0) << most_work;
    EXPECT_GE(work, 1) << most_work << ": J, of the first push";
  }
}

// A box at rest is hit from the side: it slides away, and stays down. The half of its support that an instant still has
// to give is no impact, and does not bounce.
TEST(Impact, WhatRestsDoesNotHop) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    Simulation s(
        fmt::format(
            "step: {{dt: 0.01, duration: 1}}\nenvelope: 5.0e-4\nrestitution: {}\ngravity: [0, 0, -10]\n"
            "shapes:\n  box: {{box: {{size: [1, 1, 1]}}, mass: 2}}\n"
            "  ball: {{sphere: {{radius: 0.1}}, mass: 1}}\n  floor: {{box: {{size: [40, 40, 1]}}}}\nbodies:\n"
            "  - {{shape: floor, static: true, position: [0, 0, -0.5]}}\n"
            "  - {{shape: box, position: [0, 0, 0.50025]}}\n"
            "  - {{shape: ball, position: [-1.2, 0, 0.50025], velocity: [3, 0, 1]}}\n",
            restitution),
        1 / 30.0);
    double fastest = 0;  // m/s upwards, right after an instant
    for (int frame = 0; frame < 15; ++frame)
      s.run(1 / 30.0, {.instant = [&](const fc::world::World& world, double) {
              fastest = std::max(fastest, world.bodies[1].state.velocity.z());
            }});
    EXPECT_GT(s.body(1).velocity.x(), 0.9) << restitution << ": it was hit";
    EXPECT_LE(fastest, 1e-3) << restitution;
  }
}

// Nothing stops a kinematic body that runs into a body which cannot give way: this is reported once, with the time. One
// that slides along such a body, as on a floor, does not run into it.
TEST(KinematicBody, IntoWhatCannotGiveWayIsReported) {
  Simulation s(
      "step: {dt: 0.01, duration: 1}\nenvelope: 5.0e-4\nshapes:\n  box: {box: {size: [1, 1, 1]}, mass: 2}\n"
      "  floor: {box: {size: [10, 10, 1]}}\n  plate: {box: {size: [0.001, 1, 1]}}\nbodies:\n"
      "  - {shape: box, kinematic: true, position: [-1.51, 0, 0.5], velocity: [1, 0, 0]}\n"
      "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
      "  - {shape: plate, static: true, position: [0, 0, 0.5]}\n"
      "  - {shape: box, kinematic: true, position: [4, 0, 10], velocity: [0, 0, -500]}\n",
      1 / 60.0);
  struct Reported {
    int kinematic, other;
    double time;
  };
  std::vector<Reported> reported;
  for (int frame = 0; frame < 150; ++frame) {
    s.run(1 / 60.0);
    for (const auto& clash : s.last.clashes)
      reported.push_back({clash.kinematic, clash.other, frame / 60.0 + clash.time});
  }
  ASSERT_EQ(reported.size(), 2U);
  EXPECT_EQ(reported[0].kinematic, 3);
  EXPECT_EQ(reported[0].other, 1) << "within one frame it is through";
  EXPECT_NEAR(reported[0].time, 9.5 / 500, 1e-6);
  EXPECT_EQ(reported[1].kinematic, 0);
  EXPECT_EQ(reported[1].other, 2);
  EXPECT_NEAR(reported[1].time, 1.0095, 1e-5);
}

// Times are those of the frame, although a row of a path divides it into parts.
TEST(KinematicBody, IsReportedInTimeOfTheFrame) {
  const auto file = scratch("kinematic") / "path.csv";
  std::ofstream(file)
      << "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.505,0,0,0,1,0,0,0\n1.505,1,0,0,1,0,0,0\n";
  Simulation s(
      "step: {dt: 0.01, duration: 1}\nenvelope: 5.0e-4\nshapes:\n  box: {box: {size: [1, 1, 1]}, mass: 2}\nbodies:\n"
      "  - {shape: box, kinematic: true, path: " +
          file.string() +
          "}\n  - {shape: box, static: true, position: [1.005, 0, 0]}\n"
          "  - {shape: box, position: [9, 0, 0]}\n",
      1 / 60.0);
  for (int frame = 0; frame < 30; ++frame) {
    s.run(1 / 60.0);
    ASSERT_TRUE(s.last.clashes.empty()) << frame;
  }
  s.run(1 / 60.0);
  ASSERT_EQ(s.last.clashes.size(), 1U);
  EXPECT_NEAR(s.last.clashes[0].time, 0.51 - 0.5, 1e-5);
}

}  // namespace

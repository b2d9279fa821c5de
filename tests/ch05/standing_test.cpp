// Islands that stand repeat their plan, and stop doing so as soon as anything is different.
#include <gtest/gtest.h>

#include "oracles.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

const std::string two_boxes =
    "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\nenvelope: 1.0e-3\nshapes:\n"
    "  box: {box: {size: [1, 1, 1]}, mass: 2}\n  ball: {sphere: {radius: 0.2}, mass: 2}\n"
    "  paddle: {box: {size: [0.5, 0.5, 0.5]}}\n  floor: {box: {size: [40, 40, 1]}}\nbodies:\n"
    "  - {shape: floor, static: true, position: [0, 0, -0.5005]}\n  - {shape: box, position: [0, 0, 0.5]}\n"
    "  - {shape: box, position: [0, 0, 1.5005]}\n";

double force_on(Simulation& s, int body) {
  double sum = 0;
  s.step({[&](const fc::world::ImpactRecord& r) {
    if (r.contact.body_b == body || r.contact.body_a == body) sum += r.impulse.impulse / s.dt;
  }});
  return sum;
}

TEST(Standing, SolvesNothingAndReportsTheSame) {
  Simulation s(two_boxes, 1 / 60.0);
  s.run(0.5);
  const Vec3 place = s.body(2).position;
  EXPECT_NEAR(force_on(s, 2), 20, 1e-9) << "N";
  EXPECT_EQ(s.last.step.solves, 0);
  EXPECT_GT(s.last.resting, 0);
  s.run(1);
  EXPECT_EQ(s.body(2).position, place);
  EXPECT_NEAR(force_on(s, 2), 20, 1e-9) << "N";
}

TEST(Standing, EndsWhenSomethingFallsOnIt) {
  Simulation s(two_boxes + "  - {shape: ball, position: [0.3, 0, 4]}\n", 1 / 60.0);
  s.run(0.5);
  EXPECT_EQ(s.last.step.solves, 0);
  int solves = 0;
  for (int frame = 0; frame < 60; ++frame) {
    s.step();
    solves += s.last.step.solves;
  }
  EXPECT_GT(solves, 0);
  EXPECT_GT(s.body(3).position.z(), 2.2) << "m: the ball is on the boxes";
  EXPECT_GT(s.smallest_gap, 0);
}

// No other stage checks what a plan proves about a kinematic body.
TEST(Standing, EndsWhenAKinematicBodyComes) {
  Simulation s(
      two_boxes + "  - {shape: paddle, kinematic: true, position: [-3, 0, 0.6], velocity: [2, 0, 0]}\n",
      1 / 60.0);
  s.run(0.5);
  EXPECT_EQ(s.last.step.solves, 0) << "it is far";
  s.run(1.5);
  EXPECT_GT(s.smallest_gap, 0) << "m";
  EXPECT_EQ(s.lost, 0) << "s";
  EXPECT_GT(s.body(1).position.x(), 1.7) << "m: the lower box was pushed";
}

TEST(Standing, EndsWhenItIsThrown) {
  Simulation s(two_boxes, 1 / 60.0);
  s.run(0.5);
  s.world.bodies[2].state.velocity = Vec3(0, 0, 1);
  s.step();
  EXPECT_GT(s.body(2).position.z(), 1.5105) << "m: it was thrown";
}

}  // namespace

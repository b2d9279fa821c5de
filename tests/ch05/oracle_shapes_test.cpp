// Cylinders, cones, compounds, guided bodies and paths inside the envelope: resting bodies stay, rolling or sliding
// bodies keep their speed, bodies on a lift or belt go along.
#include <gtest/gtest.h>

#include "oracles.hpp"

namespace oracle_shapes {  // the chapter's oracles are compiled as one
namespace {

using namespace fc_test;
using fc::Vec3;

constexpr double kEnvelope = 5e-4;

const std::string head =
    "step: {dt: 0.01, duration: 2}\ngravity: [0, 0, -10]\nenvelope: 5.0e-4\nshapes:\n"
    "  floor: {box: {size: [20, 20, 1]}}\n"
    "  can: {cylinder: {radius: 0.3, length: 0.8}, density: 1000}\n"
    "  hat: {cone: {radius: 0.3, length: 0.5}, density: 1000}\n"
    "  bell: {parts: [{sphere: {radius: 0.2}, position: [-0.5, 0, 0]}, {sphere: {radius: 0.2}, position: [0.5, 0, 0]},\n"
    "                 {cylinder: {radius: 0.1, length: 1}, rotation: {axis: [0, 1, 0], degrees: 90}}], density: 1000}\n"
    "  plank: {parts: [{box: {size: [1, 1, 0.2]}, position: [-0.5, 0, 0]},\n"
    "                  {box: {size: [1, 1, 0.2]}, position: [0.5, 0, 0]}], density: 500}\n"
    "  cube: {box: {size: [0.2, 0.2, 0.2]}, mass: 1}\n"
    "bodies:\n  - {shape: floor, static: true, position: [0, 0, -0.5]}\n";

void expect_sound(const Simulation& sim) {
  EXPECT_EQ(sim.lost, 0);
  EXPECT_EQ(sim.penetration, 0);
  EXPECT_GT(sim.smallest_gap, 0);
}

TEST(Shapes, CansConesAndDumbbellsStand) {
  Simulation sim(head +
                     "  - {shape: can, position: [0, 0, 0.45]}\n  - {shape: can, position: [0, 0, 1.3]}\n"
                     "  - {shape: hat, position: [-2, 0, 0.3]}\n  - {shape: bell, position: [0, 3, 0.25]}\n",
                 0.01);
  sim.run(2);
  expect_sound(sim);
  const double rests[] = {0.4, 1.2, 0.125, 0.2};  // m, of the centres of mass
  for (int i = 1; i <= 4; ++i) {
    EXPECT_NEAR(sim.body(i).position.z(), rests[i - 1], 2 * kEnvelope) << i;
    EXPECT_LT(sim.body(i).velocity.norm() + sim.body(i).spin.norm(), 1e-4) << i;
  }
}

TEST(Shapes, ACanRollsOn) {
  Simulation sim(head +
                     "  - {shape: can, position: [0, 0, 0.301], rotation: {axis: [1, 0, 0], degrees: 90},"
                     " velocity: [1, 0, 0], spin: [0, 3.3333333333333333, 0]}\n",
                 0.01);
  sim.run(2);
  expect_sound(sim);
  EXPECT_NEAR(sim.body(1).position.x(), 2, 1e-6);
  EXPECT_NEAR(sim.body(1).position.z(), 0.3, 2 * kEnvelope);
  EXPECT_LT((sim.body(1).spin - Vec3(0, 10.0 / 3, 0)).norm(), 1e-6);
}

TEST(Shapes, ACubeSlidesOverTheSeamOfAPlank) {
  Simulation sim(head +
                     "  - {shape: plank, position: [0, 0, 0.1002]}\n"
                     "  - {shape: cube, position: [-0.3, 0, 0.3005], velocity: [0.3, 0, 0]}\n",
                 0.01);
  sim.run(2);
  expect_sound(sim);
  EXPECT_NEAR(sim.body(2).position.x(), 0.3, 1e-6);
  EXPECT_NEAR(sim.body(2).velocity.x(), 0.3, 1e-9);
}

TEST(Shapes, AGuidedCubeSlidesDownItsWireAndRests) {
  Simulation sim(
      head +
          "  - {shape: cube, position: [0, 0, 0.5], fixed: [x, rx, ry, rz], velocity: [0, 0.5, 0]}\n"
          "  - {shape: cube, position: [3, 0, 0.5], fixed: [x, y, z, rx, ry]}\n",
      0.01);
  sim.run(2);
  expect_sound(sim);
  EXPECT_EQ(sim.body(1).position.x(), 0);
  EXPECT_NEAR(sim.body(1).position.y(), 1, 1e-9);
  EXPECT_NEAR(sim.body(1).position.z(), 0.1, 2 * kEnvelope);
  EXPECT_EQ(sim.body(2).position, Vec3(3, 0, 0.5));  // nothing holds it but its fixed degrees of freedom
}

TEST(Shapes, ALiftCarriesACubeAlongItsPath) {
  const auto file = scratch("paths") / "lift.csv";
  std::ofstream(file) << "t,px,py,pz,qw,qx,qy,qz\n0.1234,5,0,0.2,1,0,0,0\n1.1234,5,0,0.7,1,0,0,0\n";
  Simulation sim(head + "  - {shape: plank, kinematic: true, path: " + file.string() +
                     "}\n  - {shape: cube, position: [5.3, 0, 0.4005]}\n",
                 0.01);
  for (int frame = 0; frame < 200; ++frame) {
    sim.step();
    ASSERT_GT(sim.body(2).position.z() - sim.body(1).position.z(), 0.2) << frame;
    if (sim.time() > 1.12) continue;  // the lift has stopped, and the cube flies on for a moment
    ASSERT_LT(sim.body(2).position.z() - sim.body(1).position.z(), 0.2 + 4 * kEnvelope) << frame;
  }
  EXPECT_EQ(sim.lost, 0);
  EXPECT_EQ(sim.body(1).position.z(), 0.7);
  EXPECT_NEAR(sim.body(2).position.z(), 0.9, 2 * kEnvelope);
}

}  // namespace
}  // namespace oracle_shapes

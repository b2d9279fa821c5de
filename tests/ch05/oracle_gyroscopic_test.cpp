// Gaps are corrected by positions alone, also for bodies that turn by Euler's equations.
#include <gtest/gtest.h>

#include "oracles.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

// A box that turns on the floor about the vertical and stands a tenth of a milliradian askew is lifted and turned to
// the rest gap, without any change of velocity: it goes on turning about the vertical alone.
TEST(Gyroscopic, GapsArePutRightByPositionsAlone) {
  for (const std::string turns : {"", "gyroscopic: true\n"})
    for (const double dt : {1 / 60.0, 1 / 120.0, 1 / 240.0}) {
      const double tilt = 1e-4, lowest = 0.3 * std::cos(tilt) + 0.5 * std::sin(tilt);
      Simulation sim(
          "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\nenvelope: 5.0e-4\n" + turns +
              "shapes:\n  box: {box: {size: [1, 0.8, 0.6]}, mass: 2}\n  floor: {box: {size: [4, 4, "
              "1]}}\nbodies:\n  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
              "  - {shape: box, position: [0, 0, " +
              number(lowest + 1e-4) + "], orientation: [" + number(std::cos(0.5 * tilt)) + ", 0, " +
              number(std::sin(0.5 * tilt)) + ", 0], spin: [0, 0, 1]}\n",
          dt);
      const fc::RigidBody& box = sim.world.bodies[1].state;
      const std::string with = ", with frames of " + number(dt) + " s, " + turns;
      double askew = 0, rise = 0, energy = sim.energy();
      while (sim.time() < 1) {
        sim.step();
        askew = std::max(askew, box.spin.head<2>().norm());
        rise = std::max(rise, sim.energy() - energy - sim.last.correction_energy);
        energy = sim.energy();
        if (sim.frame == 1) {
          EXPECT_NEAR((box.orientation * Vec3::UnitZ()).head<2>().norm(), 0.8 * tilt, 0.01 * tilt)
              << "rad: a fifth is made up in a frame" << with;
        }
      }
      EXPECT_LE(askew, 1e-9) << "rad/s" << with;
      EXPECT_LE(rise, 1e-9) << "J in a frame" << with;
      EXPECT_NEAR(box.spin.z(), 1, 1e-9) << "rad/s" << with;
      EXPECT_EQ(sim.lost, 0) << "s" << with;
    }
}

}  // namespace

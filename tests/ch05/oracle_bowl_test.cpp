// The bunny of 69,666 triangles in a bowl, which is a mesh, too, and hollow.
#include <gtest/gtest.h>

#include "oracles.hpp"

namespace {

using namespace fc_test;

// The bunny falls beside the middle of a bowl, slides and tumbles. Whatever it does: nothing overlaps in any frame, no
// time is lost, and no frame has more energy than the one before, except for what the correction of gaps adds and
// reports. (Constant spin between impacts conserves the kinetic energy, too.)
TEST(Bunny, InABowl) {
  FC_SKIP_WITHOUT_THE_BUNNY();
  const std::filesystem::path scenes = FC_SOURCE_DIR "/chapters/ch05_resting_contact/scenes";
  const fc::Scene scene = fc::read_scene({scenes / "bowl.yaml", {}, {}, 5});
  const std::vector<independent::Solid> solids = {
      independent::make_solid(independent::read_obj(scenes / "bowl.obj"), 1),
      independent::make_solid(independent::read_obj(bunny_file), 1000)};
  ASSERT_EQ(solids[0].mesh.triangles.size(), 768U);
  for (const double dt : kFrames) {
    const std::string with = " with frames of " + number(dt) + " s";
    Simulation sim(scene, dt);
    const double start = sim.energy();
    double rise = 0, energy = start;
    int contacts = 0;
    while (sim.time() < 1.2) {
      sim.step();
      rise = std::max(rise, sim.energy() - energy - sim.last.correction_energy);
      energy = sim.energy();
      contacts += sim.last.step.impacts + sim.last.resting;
      const auto states = states_of(sim.world, 0);
      ASSERT_FALSE(independent::overlap(solids[0], states[0], solids[1], states[1]))
          << "in frame " << sim.frame << with;
    }
    EXPECT_GT(contacts, 10) << with;
    EXPECT_LE(rise, 1e-9 * 10 * solids[1].mass) << "J in a frame" << with;
    EXPECT_LE(energy - sim.corrected, 0.9 * start) << "J: it has hit the bowl without bounce" << with;
    EXPECT_EQ(sim.lost, 0) << "s" << with;
    EXPECT_GT(sim.smallest_gap, 0) << "m" << with;
    EXPECT_EQ(sim.penetration, 0) << "m" << with;
  }
}

}  // namespace

// A live scene of chapter 6: friction in the account, and switched on and off.
#include "ch06_friction/rubbing.hpp"
#include "support/live_scenes.hpp"

namespace {

using namespace fc_test;

const std::string rubbing = corner_scene("friction: 0.4\nrestitution: 0.3\n", 3);

LiveScene open(const std::string& text = rubbing) {
  return {text, fc::friction::live_chapter()};
}

void run(const fc::Scene& scene, const fc::RunContext& context, fc::Summary& summary) {
  fc::resting::RunOptions options;
  options.law = [](fc::world::World& world) { return std::make_unique<fc::friction::CoulombLaw>(world); };
  fc::resting::run_scene(fc::friction::with_envelope(scene), context, summary, options);
}

TEST(LiveFriction, AccountIsClosedAndNothingOverlapsWhileAUserPlays) {
  const LiveScene scene = open();
  play(scene, 1500, 50, 3);
  EXPECT_LT(entry(scene->snapshot(), "friction"), 0);
}

TEST(LiveFriction, ABodyDraggedIntoAWallStaysOutside) {
  expect_outside_of_wall(open(), 7);
}

TEST(LiveFriction, ASavedSceneRunsAlike) {
  const LiveScene scene = open();
  pull_and_throw(scene, fc::Vec3::Zero());
  expect_saved_runs_alike(scene, run);
}

// A box that slides 1 m on the floor: friction's entry is the loss of its kinetic energy.
TEST(LiveFriction, TheAccountNamesFriction) {
  const LiveScene scene = open(
      "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -9.81]\nfriction: 0.5\nshapes:\n"
      "  floor: {box: {size: [50, 50, 1]}}\n  box: {box: {size: [1, 1, 0.2]}, mass: 3}\nbodies:\n"
      "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
      "  - {shape: box, position: [0, 0, 0.1005], velocity: [3, 0, 0]}\n");
  for (int frame = 0; frame < 100; ++frame) scene->step();
  const auto now = scene->snapshot();
  EXPECT_NEAR(entry(now, "friction"), -0.5 * 3 * 9, 0.05);
  EXPECT_NEAR(entry(now, "impacts") + entry(now, "corrections"), 0, 0.05);
}

TEST(LiveFriction, FrictionIsASwitchAndAKnob) {
  const LiveScene scene = open();
  Bookkeeper book(scene->snapshot());
  for (const char* friction : {"none", "0.4", "0", "2", "none", "0.1"}) {
    EXPECT_TRUE(scene->set("friction", friction).rebuilt);
    for (int frame = 0; frame < 30; ++frame) {
      scene->step();
      book.look(scene->snapshot());
    }
  }
  EXPECT_NE(
      refusal([&] { scene->set("solver.method", "lemke"); }).find("no effect on contacts with friction"),
      std::string::npos);
  scene->step();
}

TEST(LiveTwin, ACopyIsAlikeToTheLastDigit) {
  expect_copy_alike(open(), fc::Vec3::Zero());
}

TEST(LiveTwin, AnotherSettingParts) {
  EXPECT_GT(farthest_with(open(), "friction", "0.2", 200), 1e-5);
  EXPECT_GT(farthest_with(open(), "step.dt", "0.005", 200), 0);
}

// Friction needs contacts that last, so their envelope is no switch while there is friction.
TEST(LiveFriction, TheEnvelopeStaysOnWithFriction) {
  const LiveScene scene = open(corner_scene("friction: 0.4\nenvelope: 1e-3\n", 1));
  const auto envelope = [&] {
    const auto effects = scene->effects();
    const auto found =
        std::find_if(effects.begin(), effects.end(), [](const auto& e) { return e.name == "envelope"; });
    EXPECT_NE(found, effects.end());
    return *found;
  };
  EXPECT_FALSE(envelope().can_switch);
  EXPECT_NE(envelope().why.find("friction needs contacts that last"), std::string::npos);
  scene->set("friction", "none");
  EXPECT_TRUE(envelope().can_switch);
}

}  // namespace

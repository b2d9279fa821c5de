// A live scene of chapter 5: contacts that last, and an envelope that changes while it runs.
#include "ch05_resting_contact/live_rest.hpp"
#include "ch05_resting_contact/rest_run.hpp"
#include "support/live_scenes.hpp"

namespace {

using namespace fc_test;

const std::string resting = corner_scene("envelope: 1e-3\nrestitution: 0.3\n", 3);

LiveScene open(const std::string& text = resting) {
  return {text, fc::resting::live_chapter()};
}

void run(const fc::Scene& scene, const fc::RunContext& context, fc::Summary& summary) {
  fc::resting::run_scene(scene, context, summary);
}

TEST(LiveRest, AccountIsClosedAndNothingOverlapsWhileAUserPlays) {
  const LiveScene scene = open();
  play(scene, 1500, 50, 2);
}

TEST(LiveRest, ABodyDraggedIntoAWallStaysOutside) {
  expect_outside_of_wall(open(), 7);
}

TEST(LiveRest, ASavedSceneRunsAlike) {
  const LiveScene scene = open();
  pull_and_throw(scene, fc::Vec3::Zero());
  expect_saved_runs_alike(scene, run);
}

// Bodies that stand are pulled up, and let fall again: the spring's last metre per second dies out at rest.
TEST(LiveRest, StandingBodiesCanBeLifted) {
  const LiveScene scene = open();
  for (int frame = 0; frame < 100; ++frame) scene->step();
  scene->grab(5, scene->snapshot().poses[5].position);
  scene->drag({1, 1, 2});
  for (int frame = 0; frame < 150; ++frame) scene->step();
  EXPECT_NEAR(scene->snapshot().poses[5].position.z(), 2, 0.01);
}

// Bodies that meet too often for events form a pile, whose impacts are part of its plans.
TEST(LiveRest, AccountIsClosedInAPile) {
  const LiveScene scene = open(
      "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -9.81]\nenvelope: 1e-3\nrestitution: 0.2\nshapes:\n  floor: {box: {size: "
      "[50, 50, 1]}}\n  box: {box: {size: [1, 1, 1]}, density: 100}\nbodies:\n  - {shape: floor, static: true, position: [0, 0, "
      "-0.5]}\n  - {shape: box, grid: {count: [4, 4, 4], spacing: [1.002, 1.002, 1.01]}, position: [0, 0, 0.6]}\n");
  const fc::Scene bodies = scene_of(scene->save().text, 5);
  scene->grab(30, scene->snapshot().poses[30].position);
  scene->drag({6, 0, 6});
  Bookkeeper book(scene->snapshot());
  for (int frame = 0; frame < 100; ++frame) {
    scene->step();
    book.look(scene->snapshot());
    if (frame % 20 == 0) expect_apart(bodies, scene->snapshot());
  }
  EXPECT_LT(entry(scene->snapshot(), "impacts"), 0);
}

TEST(LiveRest, StagesAddUpToTheStep) {
  expect_stages_add_up(open());
}

// A wider envelope, or a narrower one, is taken while bodies rest: no overlap, and the account stays closed.
TEST(LiveRest, TheEnvelopeChangesUnderRestingBodies) {
  const LiveScene scene = open();
  for (int frame = 0; frame < 60; ++frame) scene->step();
  const fc::Scene bodies = scene_of(scene->save().text, 5);
  Bookkeeper book(scene->snapshot());
  for (const char* envelope : {"1e-2", "2e-4", "0", "2e-2", "1e-3"}) {
    const auto before = bits(scene->snapshot()).substr(bits(scene->snapshot()).find('\n'));
    EXPECT_TRUE(scene->set("envelope", envelope).rebuilt);
    EXPECT_EQ(bits(scene->snapshot()).substr(bits(scene->snapshot()).find('\n')), before);
    for (int frame = 0; frame < 50; ++frame) {
      scene->step();
      book.look(scene->snapshot());
      expect_apart(bodies, scene->snapshot());
    }
  }
  const std::string before = bits(scene->snapshot());
  EXPECT_NE(refusal([&] { scene->set("envelope", "1e-6"); }).find("100 tolerances"), std::string::npos);
  EXPECT_NE(refusal([&] { scene->set("ccd.tolerance", "1e-3"); }).find("100 tolerances"), std::string::npos);
  EXPECT_EQ(bits(scene->snapshot()), before);
}

// Chapter 4's motion and back: the effect is a switch.
TEST(LiveRest, TheEnvelopeIsASwitch) {
  const LiveScene scene = open();
  Bookkeeper book(scene->snapshot());
  for (const char* envelope : {"none", "1e-3", "none"}) {
    EXPECT_TRUE(scene->set("envelope", envelope).rebuilt);
    for (int frame = 0; frame < 30; ++frame) {
      scene->step();
      book.look(scene->snapshot());
    }
  }
}

// The default envelope follows from the smallest shape that moves; a ball that is thrown does not change it.
TEST(LiveRest, AThrownBallLeavesTheEnvelope) {
  const LiveScene scene = open(corner_scene("envelope: 0\n", 1));
  const auto envelope = [&] {
    for (const fc::live::Knob& knob : scene->knobs())
      if (knob.key == "envelope") return knob.value;
    return std::string();
  };
  const std::string before = envelope();
  scene->throw_ball({-3, 0, 3}, {0, 0, 0});
  EXPECT_EQ(envelope(), before);
  scene->set("restitution", "0.1");
  EXPECT_EQ(envelope(), before);
  expect_saved_runs_alike(scene, run);
  EXPECT_EQ(envelope(), before);
}

TEST(LiveRest, ContactsThatLastAreMarked) {
  const LiveScene scene = open();
  for (int frame = 0; frame < 100; ++frame) scene->step();
  const auto now = scene->snapshot();
  fc::Vec3 sum = fc::Vec3::Zero();
  for (const fc::live::ContactMark& contact : now.contacts) {
    EXPECT_TRUE(contact.rests);
    sum += (contact.body_a < 2 ? 1 : -1) * contact.impulse;
  }
  const double mass = 6 * 0.4 * 0.5 * 0.6 * 500 + 800 * 4 * M_PI / 3 * 0.027;
  EXPECT_NEAR(sum.z(), mass * 9.81 * 0.01, 1e-6 * mass);  // N s: they carry the weight
}

TEST(LiveTwin, ACopyIsAlikeToTheLastDigit) {
  expect_copy_alike(open(), fc::Vec3::Zero());
}

TEST(LiveTwin, AnotherSettingParts) {
  EXPECT_GT(farthest_with(open(), "envelope", "2e-3", 200), 1e-5);
  EXPECT_GT(farthest_with(open(), "step.dt", "0.005", 200), 0);
}

TEST(LiveTwin, AThousandBoxesHaveACopy) {
  const LiveScene of = open(
      "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -9.81]\nenvelope: 1e-3\nshapes:\n  floor: {box: {size: [50, 50, 1]}}\n"
      "  box: {box: {size: [0.5, 0.5, 0.5]}, density: 100}\nbodies:\n  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
      "  - {shape: box, grid: {count: [10, 10, 10], spacing: [1, 1, 0.5005]}, position: [-4.5, -4.5, 0.2505]}\n");
  TwoScenes two(of);
  two.copies.begin_twin();
  for (int frame = 0; frame < 10; ++frame) two.step();
  expect_alike(two);
}

// Nothing can stop a kinematic body that runs into a static one: the page says so, with the time since the scene's start.
TEST(LiveRest, ClashesAreAWarning) {
  const LiveScene scene = open(
      "step: {dt: 0.01, duration: 1}\nenvelope: 1e-3\nshapes:\n  box: {box: {size: [1, 1, 1]}, mass: 1}\nbodies:\n"
      "  - {shape: box, static: true}\n  - {shape: box, kinematic: true, position: [2, 0, 0], velocity: [-2, 0, 0]}\n");
  for (int frame = 0; frame < 20; ++frame) scene->step();
  EXPECT_TRUE(scene->snapshot().warnings.empty());
  scene->set("restitution", "0.5");  // another pipeline
  for (int frame = 0; frame < 80; ++frame) scene->step();
  const auto warnings = scene->snapshot().warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].substr(0, 5), "at 0.");
  EXPECT_NEAR(std::stod(warnings[0].substr(3)), 0.5, 0.011);
  EXPECT_NE(warnings[0].find("nothing stops it"), std::string::npos);
  scene->reset();
  EXPECT_TRUE(scene->snapshot().warnings.empty());
}

// The effects' costs are parts of the frame, and none is told twice.
TEST(LiveRest, EffectsCostNoMoreThanTheFrame) {
  const LiveScene scene = open();
  double plans = 0, impacts = 0;
  for (int frame = 0; frame < 50; ++frame) {
    scene->step();
    double sum = 0;
    for (const fc::live::EffectState& effect : scene->effects()) {
      sum += effect.ms;
      if (effect.name == "plans") plans += effect.ms;
      if (effect.name == "impact law") impacts += effect.ms;
    }
    EXPECT_LE(sum, scene->snapshot().step_ms * 1.001);
  }
  EXPECT_GT(plans, 0);
  EXPECT_GT(impacts, 0);
}

}  // namespace

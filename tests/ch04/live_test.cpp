// A live scene of chapter 4: what a page can do to it, and what must hold whatever it does.
#include "support/live_scenes.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

const std::string bouncing = corner_scene("restitution: 0.5\n", 3);

LiveScene open(const std::string& text = bouncing) {
  return {text, fc::world::live_chapter()};
}

TEST(Live, AccountIsClosedAndNothingOverlapsWhileAUserPlays) {
  const LiveScene scene = open();
  play(scene, 1500, 50, 1);
}

// Without gravity: what lies on a floor is frozen in chapter 4.
TEST(Live, ABodyDraggedIntoAWallStaysOutside) {
  const LiveScene scene = open();
  scene->set("gravity", "none");
  expect_outside_of_wall(scene, 7);
}

TEST(Live, ASavedSceneRunsAlike) {
  const LiveScene scene = open();
  pull_and_throw(scene, Vec3(0.1, 0, 0.2));
  expect_saved_runs_alike(scene,
                          [](const fc::Scene& saved, const fc::RunContext& context, fc::Summary& summary) {
                            fc::world::run_scene(saved, context, summary, fc::world::step);
                          });
}

TEST(Live, SettingsThatChangeLiveKeepTheStateToTheLastBit) {
  const LiveScene scene = open();
  scene->set("gyroscopic", "true");
  for (int frame = 0; frame < 37; ++frame) scene->step();
  const auto before = scene->snapshot();
  for (const auto& [key, value] : {std::pair("ccd.tolerance", "1e-4"),
                                   {"ccd.max_iterations", "5000"},
                                   {"step.dt", "0.02"},
                                   {"restitution", "0.9"},
                                   {"drag", "{linear: 0.1}"},
                                   {"drag.angular", "0.2"},
                                   {"sleep.after", "0.5"},
                                   {"gyroscopic", "none"},
                                   {"drag", "none"},
                                   {"sleep", "none"},
                                   {"solver.method", "lemke"},
                                   {"shapes.ball.restitution", "0.1"},
                                   {"pairs", "[{a: ball, b: block, restitution: 0.7}]"}}) {
    const fc::live::Answer answer = scene->set(key, value);
    EXPECT_TRUE(answer.rebuilt && !answer.restarted) << key;
    EXPECT_GT(answer.ms, 0);
    auto now = scene->snapshot();
    now.min_gap = before.min_gap;
    EXPECT_EQ(bits(now), bits(before)) << key;
  }
  EXPECT_EQ(scene->snapshot().frame, 37);
  EXPECT_EQ(scene->snapshot().dt, 0.02);
  const int geometry = scene->geometry();
  EXPECT_TRUE(scene->set("shapes.ball.sphere.radius", "0.25").restarted);
  EXPECT_EQ(scene->snapshot().frame, 0);
  EXPECT_GT(scene->geometry(), geometry);
}

// The same frames follow when a setting is made that is already in force.
TEST(Live, ARebuiltWorldGoesOnAsItWould) {
  const LiveScene one = open(), other = open();
  for (int frame = 0; frame < 150; ++frame) {
    if (frame % 10 == 3) other->set("restitution", "0.5");
    one->step();
    other->step();
    ASSERT_EQ(bits(one->snapshot()), bits(other->snapshot())) << frame;
  }
}

TEST(Live, WhatIsRefusedChangesNothing) {
  const LiveScene scene = open();
  for (int frame = 0; frame < 30; ++frame) scene->step();
  const std::string before = bits(scene->snapshot());
  const auto set = [&](const char* key, const char* value) {
    return refusal([&] { scene->set(key, value); });
  };
  EXPECT_NE(set("ccd.tolerance", "x").find("'tolerance' must be a number"), std::string::npos);
  EXPECT_NE(set("ccd.tolerence", "1").find("unknown key"), std::string::npos);
  EXPECT_NE(set("friction", "0.5").find("comes with chapter 6"), std::string::npos);
  EXPECT_NE(set("envelope", "0").find("comes with chapter 5"), std::string::npos);
  EXPECT_NE(set("step", "none").find("missing key 'step'"), std::string::npos);
  EXPECT_NE(set("drag", "none").find("no key 'drag'"), std::string::npos);
  EXPECT_NE(set("bodies.2.position", "[3.5, 0, 1]").find("overlap"), std::string::npos);
  EXPECT_NE(set("restitution=1", "0").find("is not a key"), std::string::npos);
  EXPECT_NE(set("", "0").find("not a key"), std::string::npos);
  EXPECT_NE(set("restitution", "[").find("restitution"), std::string::npos);
  const auto refused = [&](const std::function<void()>& command) { return !refusal(command).empty(); };
  EXPECT_TRUE(refused([&] { scene->throw_ball({3.5, 0, 4}, {0, 0, 0}); }));  // in the wall
  EXPECT_TRUE(refused([&] { scene->throw_ball(Vec3::Constant(1e300), {0, 0, 0}); }));
  EXPECT_TRUE(refused([&] { scene->throw_ball({0, 0, 5}, Vec3::Constant(std::nan(""))); }));
  EXPECT_TRUE(refused([&] { scene->grab(0, {0, 0, 0}); }));  // static
  EXPECT_TRUE(refused([&] { scene->grab(-1, {0, 0, 0}); }));
  EXPECT_TRUE(refused([&] { scene->grab(99, {0, 0, 0}); }));
  EXPECT_TRUE(refused([&] { scene->grab(2, Vec3::Constant(INFINITY)); }));
  EXPECT_TRUE(refused([&] { scene->drag({0, 0, 0}); }));
  EXPECT_EQ(bits(scene->snapshot()), before);
  const LiveScene untouched = open();
  for (int frame = 0; frame < 30; ++frame) untouched->step();
  for (int frame = 0; frame < 30; ++frame) {
    scene->step();
    untouched->step();
  }
  EXPECT_EQ(bits(scene->snapshot()), bits(untouched->snapshot()));
}

TEST(Live, ResetBeginsAgainWithWhatWasSet) {
  const LiveScene scene = open(), other = open();
  scene->set("restitution", "0.25");
  other->set("restitution", "0.25");
  const std::string start = bits(scene->snapshot());
  scene->throw_ball({0, 0, 5}, {1, 0, 0});
  for (int frame = 0; frame < 20; ++frame) scene->step();
  EXPECT_TRUE(scene->reset().restarted);
  EXPECT_EQ(bits(scene->snapshot()), start);
  EXPECT_EQ(scene->snapshot().t, 0);
  EXPECT_EQ(sum_of(scene->snapshot()), 0);
  for (int frame = 0; frame < 60; ++frame) {
    scene->step();
    other->step();
  }
  EXPECT_EQ(bits(scene->snapshot()), bits(other->snapshot()));
}

// The spring is critically damped, and nothing else acts: the point comes within a hundredth of the way in 0.7 s (6.6 time
// constants), and goes past it by no more than that.
TEST(Live, TheHandPullsToItsTargetAndHolds) {
  const LiveScene scene = open(
      "step: {dt: 0.005, duration: 1}\ngravity: [0, 0, -9.81]\nshapes:\n  ball: {sphere: {radius: 0.1}, "
      "mass: 2}\nbodies:\n  - {shape: ball}\n");
  scene->grab(0, {0, 0, 0});
  scene->drag({0, 0, 0.5});
  double highest = 0;
  for (int frame = 0; frame < 140; ++frame) {
    scene->step();
    highest = std::max(highest, scene->snapshot().poses[0].position.z());
  }
  EXPECT_NEAR(scene->snapshot().poses[0].position.z(), 0.5, 0.005);
  EXPECT_LT(highest, 0.505);
  EXPECT_NEAR(entry(scene->snapshot(), "hand"), 2 * 9.81 * scene->snapshot().poses[0].position.z(),
              0.02);  // J
  scene->drop();
  for (int frame = 0; frame < 100; ++frame) scene->step();
  EXPECT_LT(scene->snapshot().poses[0].position.z(), 0);
}

// A far target makes no speed beyond what the largest force allows: 20 g times the time constant, halved by the damping.
TEST(Live, TheHandsForceIsBounded) {
  const LiveScene scene = open(
      "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -9.81]\nshapes:\n  ball: {sphere: {radius: 0.1}, "
      "mass: 2}\nbodies:\n  - {shape: ball}\n");
  scene->grab(0, {0, 0, 0});
  scene->drag({1e8, 0, 0});
  double x = 0;
  for (int frame = 0; frame < 300; ++frame) {
    scene->step();
    const double next = scene->snapshot().poses[0].position.x();
    EXPECT_LT(next - x, 0.01 * 20 * 9.81 * 0.1 / 2 * 1.01);
    x = next;
  }
  EXPECT_GT(x, 20);
}

TEST(Live, AHeldBodyKeepsItsFixedDegreesOfFreedomAndSleepersWake) {
  const LiveScene scene = open(
      "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -9.81]\nsleep: {after: 0.1}\nshapes:\n  box: {box: {size: [1, 1, 1]}, mass: "
      "1}\n  floor: {box: {size: [9, 9, 1]}}\nbodies:\n  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
      "  - {shape: box, position: [0, 0, 0.5000001], fixed: [y, rx, rz]}\n");
  for (int frame = 0; frame < 100; ++frame) scene->step();
  const auto asleep = scene->snapshot();
  scene->step();
  EXPECT_EQ(bits(scene->snapshot()).substr(20), bits(asleep).substr(20));
  scene->grab(1, {0.5, 0.5, 1});
  scene->drag({1, 3, 3});
  for (int frame = 0; frame < 100; ++frame) scene->step();
  const fc::live::Pose pose = scene->snapshot().poses[1];
  EXPECT_GT(pose.position.z(), 1.5);
  EXPECT_EQ(pose.position.y(), 0);
  EXPECT_NEAR(pose.orientation.x(), 0, 1e-12);
  EXPECT_NEAR(pose.orientation.z(), 0, 1e-12);
}

TEST(Live, DragIsBookedAndIsALoss) {
  const LiveScene scene = open();
  scene->set("drag", "{linear: 0.5, angular: 0.5}");
  Bookkeeper book(scene->snapshot());
  double last = 0;
  for (int frame = 0; frame < 100; ++frame) {
    scene->step();
    book.look(scene->snapshot());
    const double drag = entry(scene->snapshot(), "drag");
    EXPECT_LE(drag, last + 1e-9);
    last = drag;
  }
  EXPECT_LT(last, -0.1);
}

TEST(Live, OverlapsBeyondANewToleranceAreRefused) {
  const LiveScene scene = open(
      "step: {dt: 0.01, duration: 1}\nccd: {tolerance: 0.01}\nshapes:\n  box: {box: {size: [1, 1, 1]}, mass: 1}\nbodies:\n"
      "  - {shape: box}\n  - {shape: box, position: [0.995, 0, 0]}\n");
  EXPECT_NE(refusal([&] { scene->set("ccd.tolerance", "1e-6"); }).find("overlap at the start"),
            std::string::npos);
  EXPECT_TRUE(scene->set("ccd.tolerance", "0.006").rebuilt);
}

TEST(Live, AHundredBallsAmongAThousandBodies) {
  const LiveScene scene = open(
      "step: {dt: 0.01, duration: 1}\nrestitution: 1\nshapes:\n  ball: {sphere: {radius: 0.3}, mass: 1}\nbodies:\n"
      "  - {shape: ball, grid: {count: [10, 10, 10], spacing: [1, 1, 1]}}\n");
  Bookkeeper book(scene->snapshot());
  double slowest = 0;
  for (int i = 0; i < 100; ++i) {
    slowest = std::max(slowest, scene->throw_ball({2.0 * (i % 10), 2.0 * (i / 10), 20}, {0, 0, -20}).ms);
    if (i % 10 == 0) scene->step();
    book.look(scene->snapshot());
  }
  EXPECT_EQ(scene->snapshot().poses.size(), 1100u);
  for (int frame = 0; frame < 60; ++frame) {
    scene->step();
    book.look(scene->snapshot());
  }
  EXPECT_GT(entry(scene->snapshot(), "throws"), 0);
  RecordProperty("slowest_throw_ms", static_cast<int>(slowest));
}

TEST(Live, APathCannotBeSavedInItsMiddle) {
  const auto folder = scratch("paths");
  std::ofstream(folder / "lift.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.2,0,0,1,1,0,0,0\n";
  const LiveScene scene = open(
      "step: {dt: 0.01, duration: 0.1}\nshapes:\n  box: {box: {size: [1, 1, 1]}, mass: 1}\nbodies:\n"
      "  - {shape: box, kinematic: true, path: " +
      (folder / "lift.csv").string() +
      "}\n"
      "  - {shape: box, position: [0, 0, 1.5]}\n");
  EXPECT_NE(scene->save().text.find("lift.csv"), std::string::npos);
  for (int frame = 0; frame < 10; ++frame) scene->step();
  EXPECT_NE(refusal([&] { scene->save(); }).find("along a path"), std::string::npos);
  EXPECT_GT(entry(scene->snapshot(), "kinematic bodies"), 0);
  for (int frame = 0; frame < 15; ++frame) scene->step();
  expect_saved_runs_alike(scene,
                          [](const fc::Scene& saved, const fc::RunContext& context, fc::Summary& summary) {
                            fc::world::run_scene(saved, context, summary, fc::world::step);
                          });
}

// What a chapter tells of the next frame it works out on a copy, hand and all: the scene stands, and then makes that frame.
TEST(Live, TheAccountOfAFrameIsMadeOnACopy) {
  fc::world::LiveChapter chapter = fc::world::live_chapter();
  const auto told = [](std::int64_t frame, double t0, const Vec3& at) {
    return fmt::format("{} {} {} {} {}", frame, t0, at.x(), at.y(), at.z());
  };
  chapter.algorithm = [&](const fc::Scene& scene, fc::world::World& copy, std::int64_t frame, double t0) {
    fc::world::step(copy, scene.step->dt);
    return told(frame, t0, copy.bodies[4].state.position);
  };
  const LiveScene scene{bouncing, chapter};
  for (int frame = 0; frame < 10; ++frame) scene->step();
  scene->grab(4, scene->snapshot().poses[4].position);
  scene->drag({0, 0, 2});
  const std::string before = bits(scene->snapshot());
  const std::string account = scene->algorithm();
  EXPECT_EQ(bits(scene->snapshot()), before);
  scene->step();
  EXPECT_EQ(account, told(10, 10 * 0.01, scene->snapshot().poses[4].position));
  chapter.algorithm = {};
  const LiveScene without{bouncing, chapter};
  EXPECT_NE(refusal([&] { without->algorithm(); }), "");
}

TEST(Live, AnEffectComesBackWithTheValueOfTheScene) {
  std::string text = bouncing;
  text.replace(text.find("-9.81"), 5, "-1.62");
  const LiveScene scene = open(text);
  scene->set("gravity", "none");
  const auto effects = scene->effects();
  const auto gravity =
      std::find_if(effects.begin(), effects.end(), [](const auto& e) { return e.name == "gravity"; });
  ASSERT_NE(gravity, effects.end());
  EXPECT_EQ(gravity->key, "gravity=[0, 0, -1.62]");
}

TEST(Live, OffersItsEffectsAndKnobs) {
  const LiveScene scene = open();
  const auto find = [](const auto& list, const std::string& name) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const auto& e) {
      if constexpr (requires { e.name; })
        return e.name == name;
      else
        return e.key == name;
    });
    EXPECT_NE(found, list.end()) << name;
    return *found;
  };
  const fc::live::EffectState gravity = find(scene->effects(), "gravity"),
                              drag = find(scene->effects(), "drag");
  EXPECT_TRUE(gravity.on && gravity.can_switch);
  EXPECT_EQ(gravity.key, "gravity=[0, 0, -9.81]");
  EXPECT_FALSE(drag.on);
  EXPECT_EQ(drag.why, "not asked for by this scene");
  EXPECT_TRUE(scene->set("drag", drag.key.substr(drag.key.find('=') + 1)).rebuilt);
  EXPECT_TRUE(find(scene->effects(), "drag").on);
  EXPECT_TRUE(scene->set("gravity", "none").rebuilt);
  EXPECT_FALSE(find(scene->effects(), "gravity").on);
  for (const fc::live::Knob& knob : scene->knobs()) {  // both ends of each can be set
    if (knob.choices.empty()) {
      scene->set(knob.key, fmt::format("{}", knob.low));
      scene->set(knob.key, fmt::format("{}", knob.high));
    }
    for (const std::string& choice : knob.choices) EXPECT_TRUE(scene->set(knob.key, choice).rebuilt);
  }
  const std::string glb = scene->glb();
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(glb.find("animations"), std::string::npos);
}

TEST(Live, StagesAddUpToTheStep) {
  expect_stages_add_up(open());
}

// A search that may look at one pair of nodes alone fails: the frame is taken back, and a setting helps.
TEST(Live, AFrameThatFailsIsTakenBack) {
  const LiveScene scene = open();
  scene->set("ccd.max_iterations", "1");
  std::string before;
  const auto run = [&] {
    for (int frame = 0; frame < 200; ++frame) {
      before = bits(scene->snapshot());
      scene->step();
    }
  };
  scene->set("solver", "{method: pgs, limit: 1}");
  EXPECT_THROW(run(), fc::NumericalFailure);
  auto after = scene->snapshot();
  EXPECT_EQ(bits(after).substr(0, 30), before.substr(0, 30));
  scene->set("solver", "none");
  scene->set("ccd.max_iterations", "none");
  for (int frame = 0; frame < 50; ++frame) scene->step();
}

}  // namespace

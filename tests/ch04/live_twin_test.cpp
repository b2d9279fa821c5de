// A live scene of chapter 4 beside its copy.
#include "support/live_scenes.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

const std::string bouncing = corner_scene("restitution: 0.5\n", 3);

LiveScene open(const std::string& text = bouncing) {
  return {text, fc::world::live_chapter()};
}

TEST(LiveTwin, APathGoesOnInTheCopy) {
  const auto folder = scratch("paths");
  std::ofstream(folder / "lift.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.3,0,0,1,0.8,0,0,0.6\n";
  const LiveScene of = open(
      "step: {dt: 0.01, duration: 0.1}\nshapes:\n  box: {box: {size: [1, 1, 1]}, mass: 1}\nbodies:\n"
      "  - {shape: box, kinematic: true, path: " +
      (folder / "lift.csv").string() + "}\n  - {shape: box, position: [0, 0, 1.5]}\n");
  for (int frame = 0; frame < 11; ++frame) of->step();
  TwoScenes two(of);
  two.copies.begin_twin();
  for (int frame = 0; frame < 40; ++frame) {
    two.step();
    expect_alike(two);
  }
  EXPECT_EQ(two.twin().now.poses[0].position.z(), 1);
}

TEST(LiveTwin, ACopyIsAlikeToTheLastDigit) {
  expect_copy_alike(open(), Vec3(0.1, 0, 0.2));
  expect_copy_alike(
      open(corner_scene("restitution: 0.8\ngyroscopic: true\ndrag: {linear: 0.1}\nsleep: {after: 0.1}\n", 2)),
      Vec3(0.1, 0, 0.2));
}

TEST(LiveTwin, AnotherSettingParts) {
  const double by_tolerance = farthest_with(open(), "ccd.tolerance", "1e-4", 200);
  EXPECT_GT(by_tolerance, 1e-6);
  EXPECT_LT(by_tolerance, 10);
  EXPECT_GT(farthest_with(open(), "step.dt", "0.005", 200), 0);
}

// A ball in free fall is where Galilei says, whatever the frame.
TEST(LiveTwin, FreeFallDoesNotDependOnTheFrame) {
  const LiveScene of = open(
      "step: {dt: 0.016666666666666666, duration: 1}\ngravity: [0, 0, -9.81]\nshapes:\n  ball: {sphere: {radius: 0.1}, "
      "mass: 2}\nbodies:\n  - {shape: ball, velocity: [3, 0, 5]}\n");
  TwoScenes two(of);
  two.copies.begin_twin();
  two.copies.set("step.dt", "0.004166666666666667", true);
  for (int frame = 0; frame < 600; ++frame) {
    two.step();
    EXPECT_LT(two.twin().distance.metres, 1e-10);  // NaN fails, too
  }
  EXPECT_EQ(two.twin().now.frame, 2400);
}

TEST(LiveTwin, ACopyThatFailsStandsStillAndTheSceneGoesOn) {
  const LiveScene of = open();
  TwoScenes two(of);
  two.copies.begin_twin();
  two.copies.set("solver", "{method: pgs, limit: 1}", true);
  for (int frame = 0; frame < 200; ++frame) two.step();
  ASSERT_TRUE(two.twin().failed.has_value());
  EXPECT_EQ(two.scene.snapshot().frame, 200);
  EXPECT_LT(two.twin().now.frame, 200);
  EXPECT_TRUE(std::isnan(two.twin().distance.metres));
  two.copies.set("solver", "none", true);  // that alone does not bring it back
  two.step();
  EXPECT_TRUE(two.twin().failed.has_value());
  two.copies.begin_twin();
  two.step();
  expect_alike(two);
}

// The first bodies differ by a rounding: a key that begins the copy again begins the scene, too.
TEST(LiveTwin, AnotherStartOfTheCopy) {
  const LiveScene of = open();
  TwoScenes two(of);
  two.copies.begin_twin();
  for (int frame = 0; frame < 10; ++frame) two.step();
  EXPECT_TRUE(two.copies.set("bodies.2.position", "[-2, 1e-9, 0.31]", true).restarted);
  EXPECT_EQ(two.scene.snapshot().frame, 0);
  EXPECT_NEAR(two.twin().distance.metres, 1e-9, 1e-16);
  EXPECT_EQ(two.twin().distance.farthest, 2);
  two.copies.set("shapes.ball.sphere.radius", "0.2", true);  // of both
  EXPECT_NEAR(two.scene.snapshot().energy, two.twin().now.energy, 1e-9);
  EXPECT_NE(refusal([&] { two.copies.set("bodies.2.position", "[3.5, 0, 1]", true); }), "");  // in the wall
  EXPECT_NEAR(two.twin().distance.metres, 1e-9, 1e-16);
}

TEST(LiveTwin, AThousandBodiesHaveACopyAtOnce) {
  const LiveScene of = open(
      "step: {dt: 0.01, duration: 1}\nrestitution: 1\nshapes:\n  ball: {sphere: {radius: 0.3}, mass: 1}\nbodies:\n"
      "  - {shape: ball, grid: {count: [10, 10, 10], spacing: [1, 1, 1]}, velocity: [1, 2, 3]}\n");
  TwoScenes two(of);
  EXPECT_LT(two.copies.begin_twin().ms, 1000);
  for (int frame = 0; frame < 10; ++frame) two.step();
  expect_alike(two);
}

}  // namespace

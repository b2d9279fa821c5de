// Two copies of a scene without physics: one time, the same hands, and what either refuses or fails at.
#include "common/live/copies.hpp"

#include <gmock/gmock.h>

#include "common/live/messages.hpp"
#include "page_side.hpp"

namespace {

using namespace fc::live;
using fc::Vec3;
using fc_test::FakeScene;
using fc_test::Message;
using fc_test::Served;
using fc_test::soon;
using fc_test::StreamReader;
using testing::HasSubstr;

// A fake scene with its copy, without a loop.
struct Two {
  FakeScene scene;
  Copies copies{scene};

  void step(int frames = 1) {
    for (int i = 0; i < frames; ++i) copies.step([] { return false; });
  }
  TwinState twin() const { return copies.twin(scene.snapshot()).value(); }
  std::string refused(const std::function<void()>& command) const {
    try {
      command();
      return "done";
    } catch (const fc::InputError& error) {
      return error.what();
    }
  }
};

TEST(Twin, ThereIsNoneUntilItIsAskedFor) {
  Two two;
  EXPECT_FALSE(two.copies.twin(two.scene.snapshot()).has_value());
  EXPECT_EQ(two.copies.end_twin().text, "there is no copy");
  EXPECT_EQ(two.refused([&] { two.copies.set("drift", "1", true); }), "there is no copy; make one first");
  EXPECT_TRUE(two.copies.begin_twin().rebuilt);
  EXPECT_TRUE(two.copies.twin(two.scene.snapshot()).has_value());
  EXPECT_EQ(two.copies.end_twin().text, "the copy has ended");
  EXPECT_FALSE(two.copies.twin(two.scene.snapshot()).has_value());
}

TEST(Twin, ItBeginsWhereTheSceneStandsAndStaysBesideIt) {
  Two two;
  two.step(5);
  two.copies.begin_twin();
  for (int frame = 0; frame < 20; ++frame) {
    EXPECT_EQ(two.twin().now.frame, 5 + frame);
    EXPECT_EQ(two.twin().distance.metres, 0);
    EXPECT_EQ(two.twin().distance.farthest, -1);
    two.step();
  }
}

TEST(Twin, TheFarthestBodyGivesTheDistance) {
  Two two;
  two.copies.begin_twin();
  EXPECT_EQ(two.copies.set("drift", "0.25", true).text, "it drifts");
  two.step(8);
  EXPECT_NEAR(two.twin().distance.metres, 2 * 0.08 * 0.25, 1e-15);  // of body 2
  EXPECT_EQ(two.twin().distance.farthest, 2);
  EXPECT_EQ(two.scene.snapshot().poses[2].position.x(), 2);  // the scene's has no drift
  two.copies.set("drift", "0.25", false);
  EXPECT_EQ(two.twin().distance.metres, 0);
}

TEST(Twin, FramesOfAQuarterMeetAfterEachOfTheScene) {
  Two two;
  two.copies.set("step.dt", "0.016666666666666666", false);
  two.step(7);
  two.copies.begin_twin();
  EXPECT_EQ(two.copies.set("step.dt", "0.004166666666666667", true).text, "rebuilt");
  for (int frame = 1; frame <= 20000; ++frame) {
    two.step();
    const TwinState twin = two.twin();
    ASSERT_EQ(twin.now.frame, 7 + 4 * frame);
    ASSERT_FALSE(std::isnan(twin.distance.metres)) << frame;
  }
}

TEST(Twin, LongerFramesWaitForTheScene) {
  Two two;
  two.copies.begin_twin();
  EXPECT_EQ(two.copies.set("step.dt", "0.03", true).text,
            "rebuilt; scene and copy stand at one time after every 3 frames of the scene");
  for (int frame = 1; frame <= 30; ++frame) {
    two.step();
    EXPECT_EQ(two.twin().now.frame, (frame + 2) / 3);
    EXPECT_EQ(std::isnan(two.twin().distance.metres), frame % 3 != 0) << frame;
  }
  EXPECT_THAT(two.copies.set("step.dt", "0.0071234567", true).text, HasSubstr("do not come to one time"));
}

TEST(Twin, HandsAndBallsAreOfBoth) {
  Two two;
  two.copies.begin_twin();
  two.copies.grab(1, {1, 2, 3});
  EXPECT_EQ(two.twin().now.grabbed, 1);
  EXPECT_EQ(two.twin().now.grab_point, Vec3(1, 2, 3));  // to the last digit
  two.copies.drag({4, 5, 6});
  EXPECT_EQ(two.twin().now.grab_target, Vec3(4, 5, 6));
  two.copies.drop();
  EXPECT_EQ(two.twin().now.grabbed, -1);
  two.copies.throw_ball({0, 0, 0}, {0, 0, 1});
  EXPECT_EQ(two.twin().now.poses.size(), 4u);
  EXPECT_EQ(two.twin().simulation->geometry(), 1);
  EXPECT_EQ(two.copies.save().text, "step: {dt: 0.01}\nbodies: []\n");
}

// Where the bodies stand apart, the same point of the body is held.
TEST(Twin, TheHandHoldsTheSamePointOfTheBody) {
  Two two;
  two.copies.begin_twin();
  two.copies.set("drift", "0.5", true);
  two.step(10);
  two.copies.grab(2, {2, 10, 1});
  EXPECT_TRUE(two.twin().now.grab_point.isApprox(Vec3(2 + 2 * 0.1 * 0.5, 10, 1), 1e-14));
}

TEST(Twin, ABallThatTheCopyRefusesFliesInNeither) {
  Two two;
  two.scene.twin_no_ball_above = 5;
  two.copies.begin_twin();
  EXPECT_EQ(two.refused([&] { two.copies.throw_ball({0, 0, 6}, {0, 0, 1}); }), "no ball can fly there");
  EXPECT_EQ(two.scene.snapshot().poses.size(), 3u);
  EXPECT_EQ(two.refused([&] { two.copies.throw_ball({0, 0, 4}, {0, 0, 1}); }), "done");
  EXPECT_EQ(two.twin().now.poses.size(), 4u);
}

TEST(Twin, WhatBeginsOneAgainBeginsBoth) {
  for (const bool of_twin : {false, true}) {
    Two two;
    two.copies.begin_twin();
    two.step(5);
    EXPECT_TRUE(two.copies.set("solver.method", "pgs", of_twin).restarted);
    EXPECT_EQ(two.scene.snapshot().frame, 0);
    EXPECT_EQ(two.twin().now.frame, 0);
    two.step(5);
    two.copies.set("bodies", "7", of_twin);  // both keep the same bodies
    EXPECT_EQ(two.scene.snapshot().poses.size(), 7u);
    EXPECT_EQ(two.twin().now.poses.size(), 7u);
    EXPECT_EQ(two.twin().distance.metres, 0);
    two.step(5);
    two.copies.reset();
    EXPECT_EQ(two.twin().now.frame, 0);
  }
}

TEST(Twin, ACopyThatCannotHaveTheSameBodiesEnds) {
  Two two;
  two.copies.begin_twin();
  EXPECT_THAT(two.copies.set("bodies", "9", false).text, HasSubstr("the copy has ended: nine are too many"));
  EXPECT_FALSE(two.copies.twin(two.scene.snapshot()).has_value());
  EXPECT_EQ(two.scene.snapshot().poses.size(), 9u);
}

TEST(Twin, ACopyThatFailsStandsStillAndTheSceneGoesOn) {
  Two two;
  two.scene.twin_fails_at = 4;
  two.copies.begin_twin();
  two.step(10);
  EXPECT_EQ(two.scene.snapshot().frame, 10);
  EXPECT_EQ(two.twin().now.frame, 3);
  EXPECT_EQ(two.twin().failed, "energy grew\nby 3 J");
  EXPECT_TRUE(std::isnan(two.twin().distance.metres));
  const int held = two.scene.holds;
  two.copies.grab(1, {0, 0, 0});  // it is not asked
  EXPECT_EQ(two.scene.holds, held + 1);
  EXPECT_EQ(two.twin().now.grabbed, -1);
  EXPECT_THAT(two.refused([&] {
    two.copies.throw_ball({0, 0, 0}, {0, 0, 1});
  }),
              HasSubstr("the copy has failed"));
  two.copies.reset();
  EXPECT_FALSE(two.twin().failed.has_value());
  EXPECT_EQ(two.twin().now.frame, 0);
  two.step(2);
  EXPECT_EQ(two.twin().now.frame, 2);
}

TEST(Twin, ASettingThatBreaksTheCopyLeavesTheScene) {
  Two two;
  two.copies.begin_twin();
  EXPECT_THAT(two.copies.set("breaks", "", true).text, HasSubstr("the copy has failed"));
  EXPECT_EQ(two.twin().failed, "nothing is as it was");
  EXPECT_THROW(two.copies.set("breaks", "", false), fc::NumericalFailure);
}

TEST(Twin, ItsManyFramesCanBeStopped) {
  Two two;
  two.copies.begin_twin();
  two.copies.set("step.dt", "0.00001", true);
  int asked = 0;
  two.copies.step([&] { return ++asked > 10; });
  EXPECT_EQ(two.twin().now.frame, 10);
}

TEST(Twin, ItsMessageIsAFramesWithTheDistance) {
  Two two;
  two.copies.begin_twin();
  two.copies.set("drift", "0.25", true);
  two.step(8);
  Course course;
  const std::string frame = frame_message(two.twin().now, 0, course),
                    of_twin = twin_message(two.twin(), course);
  ASSERT_EQ(of_twin.size(), frame.size() + 12);
  std::uint32_t length = 0, kind = 0;
  std::int32_t farthest = 0;
  double distance = 0;
  std::memcpy(&length, of_twin.data(), 4);
  std::memcpy(&kind, of_twin.data() + 4, 4);
  std::memcpy(&distance, of_twin.data() + 8, 8);
  std::memcpy(&farthest, of_twin.data() + 16, 4);
  EXPECT_EQ(length, of_twin.size() - 4);
  EXPECT_EQ(kind, 3u);
  EXPECT_EQ(distance, two.twin().distance.metres);
  EXPECT_EQ(farthest, 2);
  EXPECT_EQ(of_twin.substr(20), frame.substr(8));
}

TEST(Twin, StateAndStreamTellOfIt) {
  Served live(3, 0.005);
  EXPECT_EQ(live.state()["twin"], nullptr);
  StreamReader stream(live.server.port(), live.stream());
  live.scene.twin_fails_at = 100000;
  const auto begun = live.command(R"({"do": "twin", "on": true})");
  EXPECT_EQ(begun.status, 200);
  EXPECT_EQ(begun.json()["rebuilt"], true);
  const Message twin = stream.next(3);
  EXPECT_EQ(twin.at<double>(0), 0);
  EXPECT_EQ(twin.at<std::int32_t>(8), -1);
  live.command(R"({"do": "set", "key": "drift", "value": "1", "of": "twin"})");
  live.command(R"({"do": "step"})");
  const auto state = live.state();
  for (const char* name :
       {"t", "frame", "failed", "dt", "step_ms", "stages", "contacts", "energy", "kinetic", "potential",
        "account", "min_gap", "lost_time", "residual", "effects", "knobs", "distance"})
    EXPECT_TRUE(state["twin"].contains(name)) << name;
  EXPECT_EQ(state["twin"]["frame"], state["frame"]);
  EXPECT_GT(state["twin"]["distance"], 0);
  EXPECT_EQ(state["twin"]["account"], state["account"]);
  EXPECT_EQ(state["warnings"], (std::vector<std::string>{"mind\\x0athe wall"}));
  EXPECT_EQ(live.command(R"({"do": "twin", "on": false})").status, 200);
  EXPECT_EQ(live.state()["twin"], nullptr);
  EXPECT_FALSE(live.scene.two_threads);
}

// A page that comes when the copy has ended sees nothing of it.
TEST(Twin, AnOldFrameOfItIsNotSent) {
  Served live(3, 0.002);
  live.command(R"({"do": "twin", "on": true})");
  StreamReader(live.server.port(), live.stream()).next(3);
  live.command(R"({"do": "twin", "on": false})");
  StreamReader stream(live.server.port(), live.stream());
  for (int i = 0; i < 20; ++i) {
    Message message;
    ASSERT_TRUE(stream.next(message));
    EXPECT_NE(message.kind, 3u);
  }
}

TEST(Twin, AFailedSceneHasNoNewCopy) {
  Served live(3, 0.002);
  live.scene.fails_at = live.scene.frames + 3;
  EXPECT_TRUE(soon([&] { return !live.state()["failed"].is_null(); }));
  EXPECT_EQ(live.command(R"({"do": "twin", "on": true})").status, 400);
  EXPECT_EQ(live.command(R"({"do": "twin", "on": false})").status, 200);
}

TEST(Algorithm, ItIsOfTheNextFrameAndPauses) {
  Served live(3, 0.002);
  live.scene.has_algorithm = true;
  EXPECT_TRUE(soon([&] { return live.scene.frames > 3; }));
  const auto answer = live.get("/algorithm");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.headers.at("content-type"), "application/json");
  EXPECT_EQ(live.state()["running"], false);
  EXPECT_EQ(answer.json()["frame"], live.scene.frames.load());
  live.scene.has_algorithm = false;
  const auto none = live.get("/algorithm");
  EXPECT_EQ(none.status, 503);
  EXPECT_EQ(none.body, "this scene has no account of its algorithm\n");
  live.scene.fails_at = live.scene.frames + 1;
  live.command(R"({"do": "step"})");
  EXPECT_EQ(live.get("/algorithm").body, "the scene has failed: reset it first\n");
  EXPECT_EQ(live.exchange(live.request("GET", "/algorithm?key=x")).status, 403);
  EXPECT_EQ(live.exchange(live.request("POST", live.target("/algorithm"))).status, 405);
  EXPECT_FALSE(live.scene.two_threads);
}

}  // namespace

// The loop without a server: its pace, what commands do, and what a failure does.
#include "common/live/loop.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "page_side.hpp"

namespace {

using namespace fc::live;
using namespace std::chrono_literals;
using fc_test::FakeScene;
using fc_test::soon;
using Kind = Loop::Reply::Kind;
using Clock = Pace::Clock;

TEST(Pace, AFrameIsDueWhenItsTimeHasPassed) {
  const Clock::time_point start{};
  Pace pace;
  pace.begin(start, 0.1);
  EXPECT_EQ(pace.due(), start + 100ms);
  pace.frame_made(start + 103ms, 0.1);  // a little late: not lost
  EXPECT_EQ(pace.due(), start + 200ms);
}

TEST(Pace, OfWhatIsLostOneFrameIsCaughtUp) {
  const Clock::time_point start{};
  Pace pace;
  pace.begin(start, 0.1);
  pace.frame_made(start + 1050ms, 0.1);  // it took ten frames' time
  EXPECT_EQ(pace.due(), start + 950ms);  // at once,
  pace.frame_made(start + 1051ms, 0.1);
  EXPECT_EQ(pace.due(), start + 1050ms);  // and the next in its turn
  pace.frame_made(start + 1052ms, 0.1);
  EXPECT_EQ(pace.due(), start + 1150ms);
}

TEST(Pace, AShorterPeriodHoldsAtOnceAndALongerOneFromTheNextFrame) {
  const Clock::time_point start{};
  Pace pace;
  pace.begin(start, 1000);
  pace.period_changed(start + 10ms, 0.1);
  EXPECT_EQ(pace.due(), start + 110ms);
  pace.period_changed(start + 20ms, 10);
  EXPECT_EQ(pace.due(), start + 110ms);
  pace.begin(start, 1e300);  // no overflow
  EXPECT_GT(pace.due(), start + 24h);
}

// A loop in a thread of its own.
class Running : public testing::Test {
 protected:
  explicit Running(double dt = 0.005) : scene_(3, dt), loop_(scene_), thread_([this] { loop_.run(); }) {}
  ~Running() override {
    loop_.stop();
    if (thread_.joinable()) thread_.join();
    EXPECT_FALSE(scene_.two_threads);
  }
  nlohmann::json ask(const Command& command, Kind expected = Kind::done) {
    const Loop::Reply reply = loop_.ask(command);
    EXPECT_TRUE(reply.kind == expected) << reply.json;
    return nlohmann::json::parse(reply.json);
  }
  std::string refused(const Command& command) { return ask(command, Kind::refused)["text"]; }
  nlohmann::json state() const {
    return nlohmann::json::parse(loop_.board().wait(0, 0, 10s).state.message->substr(message_header));
  }

  FakeScene scene_;
  Loop loop_;
  std::thread thread_;
};

TEST_F(Running, SimulatedTimeNeverRunsAhead) {
  EXPECT_TRUE(soon([&] { return scene_.frames >= 20; }));
  const auto frames = scene_.frames.load();
  const auto passed = Clock::now().time_since_epoch() - scene_.begun.load();  // since the first frame
  // The first frame may have begun late, and one frame is caught up.
  EXPECT_LE(0.005 * static_cast<double>(frames - 2), std::chrono::duration<double>(passed).count());
}

TEST_F(Running, SlowMotionIsSlower) {
  ask(command::Speed{0.05});  // a frame in 100 ms
  const auto start = Clock::now();
  const auto before = scene_.frames.load();
  EXPECT_TRUE(soon([&] { return scene_.frames >= before + 6; }));
  EXPECT_GE(Clock::now() - start,
            3 * 100ms - 1ms);  // on a busy machine three of the six may have been due already
  EXPECT_EQ(state()["speed"], 0.05);
}

TEST_F(Running, PausesStepsAndRuns) {
  ask(command::Pause{});
  const auto at = scene_.frames.load();
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(scene_.frames, at);
  EXPECT_EQ(state()["running"], false);
  ask(command::Step{});
  EXPECT_EQ(scene_.frames, at + 1);
  EXPECT_EQ(state()["frame"], at + 1);
  ask(command::Run{});
  EXPECT_TRUE(soon([&] { return scene_.frames > at + 2; }));
  ask(command::Step{});  // of a scene that runs: it is paused after it
  EXPECT_EQ(state()["running"], false);
}

TEST_F(Running, CommandsReachTheScene) {
  ask(command::Pause{});
  EXPECT_EQ(ask(command::Set{"step.dt", "0.02"})["rebuilt"], true);
  EXPECT_EQ(state()["dt"], 0.02);
  const auto restarted = ask(command::Set{"solver.method", "pgs"});
  EXPECT_EQ(restarted["restarted"], true);
  EXPECT_EQ(restarted["ms"], 2.5);
  EXPECT_EQ(refused(command::Set{"no", "x"}), "--set no=x: no such key");
  EXPECT_EQ(refused(command::Grab{9, {0, 0, 0}}), "there is no body 9");
  ask(command::Grab{1, {1, 2, 3}});
  ask(command::Drag{{4, 5, 6}});
  const auto frame = *loop_.board().news().frame.message;
  float target = 0;
  std::memcpy(&target, frame.data() + frame.size() - 4, 4);
  EXPECT_EQ(target, 6);
  ask(command::Drop{});
  ask(command::Throw{{0, 0, 0}, {0, 0, 1}});
  EXPECT_EQ(state()["bodies"], 4);
  EXPECT_EQ(state()["geometry"], 1);
  EXPECT_EQ(ask(command::Save{})["scene"], "step: {dt: 0.01}\nbodies: []\n");
  EXPECT_EQ(*loop_.glb(), "glTF 1 at frame 0");
  ask(command::Step{});
  EXPECT_EQ(*loop_.glb(), "glTF 1 at frame 1");
}

TEST_F(Running, AFailureIsShownAndResetMendsIt) {
  scene_.fails_at = scene_.frames + 3;
  EXPECT_TRUE(soon([&] { return !state()["failed"].is_null(); }));
  EXPECT_EQ(state()["failed"], "energy grew\\x0aby 3 J");
  EXPECT_EQ(state()["running"], false);
  EXPECT_EQ(refused(command::Run{}), "the scene has failed: reset it first");
  for (const Command& command : {Command(command::Step{}), Command(command::Drop{}), Command(command::Save{}),
                                 Command(command::Throw{{0, 0, 0}, {0, 0, 1}}),
                                 Command(command::Grab{1, {0, 0, 0}}), Command(command::Drag{{0, 0, 0}})})
    EXPECT_EQ(refused(command), "the scene has failed: reset it first");
  ask(command::Pause{});
  ask(command::Set{"step.dt", "0.004"});  // possible; but only a beginning mends what has failed
  EXPECT_FALSE(state()["failed"].is_null());
  scene_.fails_at = -1;
  EXPECT_EQ(ask(command::Reset{})["restarted"], true);
  EXPECT_TRUE(state()["failed"].is_null());
  EXPECT_EQ(state()["frame"], 0);
  EXPECT_EQ(state()["running"], false);
  ask(command::Run{});
  EXPECT_TRUE(soon([&] { return scene_.frames > 2; }));
}

TEST_F(Running, AStepOrACommandThatFailsIsRefusedWithTheReason) {
  ask(command::Pause{});
  scene_.fails_at = scene_.frames + 1;
  EXPECT_EQ(refused(command::Step{}), "energy grew\\x0aby 3 J");
  EXPECT_FALSE(state()["failed"].is_null());
  scene_.fails_at = -1;
  ask(command::Set{"solver.method", "pgs"});  // begins again
  EXPECT_TRUE(state()["failed"].is_null());
  EXPECT_EQ(refused(command::Set{"breaks", ""}), "nothing is as it was");
  EXPECT_EQ(state()["failed"], "nothing is as it was");
}

TEST_F(Running, StopWaitsForTheStepThatHasBegunAndNoOther) {
  scene_.step_ms = 100;
  EXPECT_TRUE(soon([&] { return scene_.in_step.load(); }));
  const auto before = scene_.steps.load();
  loop_.stop();
  thread_.join();
  EXPECT_FALSE(scene_.in_step);
  EXPECT_LE(scene_.steps, before + 1);
  EXPECT_TRUE(loop_.board().news().closed);
  ask(command::Run{}, Kind::ended);
  EXPECT_EQ(loop_.glb(), nullptr);
}

TEST_F(Running, WhoeverWaitsWhenItEndsIsAnswered) {
  scene_.step_ms = 50;
  std::vector<std::thread> pages;
  std::atomic<int> answers = 0;
  for (int i = 0; i < 8; ++i)
    pages.emplace_back([&] {
      while (loop_.ask(command::Run{}).kind != Kind::ended) {
      }
      ++answers;
    });
  ask(command::Stop{});
  for (std::thread& page : pages) page.join();
  EXPECT_EQ(answers, 8);
}

TEST(Loop, WhatElseTheSceneThrowsComesOut) {
  struct Broken : FakeScene {
    std::vector<Knob> knobs() const override { throw std::logic_error("no knobs"); }
  } scene;
  Loop loop(scene);
  EXPECT_THROW(loop.run(), std::logic_error);
  EXPECT_TRUE(loop.ask(command::Run{}).kind == Kind::ended);
  EXPECT_TRUE(loop.board().news().closed);
}

}  // namespace

// The bytes of STREAM.md, read back by hand.
#include "common/live/messages.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "fake_scene.hpp"

namespace {

using namespace fc::live;

template <class Number>
Number take(std::string_view& bytes) {
  Number number;
  std::memcpy(&number, bytes.substr(0, sizeof number).data(), sizeof number);
  bytes.remove_prefix(sizeof number);
  return number;
}

void expect_floats(std::string_view& bytes, const std::vector<float>& expected) {
  for (const float x : expected) EXPECT_EQ(take<float>(bytes), x);
}

TEST(Messages, AFrameIsAsTheContractSays) {
  fc_test::FakeScene scene(2);
  scene.frames = 5;
  scene.grab(1, {7, 8, 9});
  scene.drag({10, 11, 12});
  Course course;
  course.failed = "why";
  const std::string message = frame_message(scene.snapshot(), 3, course);
  std::string_view rest = message;
  EXPECT_EQ(take<std::uint32_t>(rest), message.size() - 4);
  EXPECT_EQ(take<std::uint32_t>(rest), 1u);
  EXPECT_EQ(take<std::uint32_t>(rest), 3u);       // geometry
  EXPECT_EQ(take<std::uint32_t>(rest), 5u);       // frame
  EXPECT_EQ(take<double>(rest), 0.05);            // t
  EXPECT_EQ(take<std::uint32_t>(rest), 1u + 2u);  // it runs; it has failed
  EXPECT_EQ(take<std::uint32_t>(rest), 2u);       // bodies
  EXPECT_EQ(take<std::uint32_t>(rest), 1u);       // contacts
  EXPECT_EQ(take<std::int32_t>(rest), 1);         // grabbed
  const auto ninths = [](int n) { return static_cast<float>(n / 9.0); };
  for (const float i : {0.0f, 1.0f})
    expect_floats(rest, {i, 5, 0.05f, ninths(-4), ninths(5), ninths(6), ninths(2)});
  expect_floats(rest, {1, 2, 3, 0, 0, 1, 4, 5, 6, 1});
  expect_floats(rest, {7, 8, 9, 10, 11, 12});
  EXPECT_TRUE(rest.empty());
}

TEST(Messages, WithoutAHandNothingOfItIsSent) {
  fc_test::FakeScene scene(2);
  Course course;
  course.running = false;
  const std::string message = frame_message(scene.snapshot(), 0, course);
  EXPECT_EQ(message.size(), 8 + 32 + 2 * 28 + 40u);
  std::string_view flags = std::string_view(message).substr(24);
  EXPECT_EQ(take<std::uint32_t>(flags), 0u);
}

TEST(Messages, TheStateHasEveryNumberAndNoneThatJsonLacks) {
  fc_test::FakeScene scene;
  Course course;
  course.speed = 0.25;
  const auto state = nlohmann::json::parse(state_text(scene, scene.snapshot(), course));
  EXPECT_EQ(state["t"], 0);
  EXPECT_EQ(state["running"], true);
  EXPECT_TRUE(state["failed"].is_null());
  EXPECT_EQ(state["title"], "fake & <scene>");
  EXPECT_EQ(state["bodies"], 3);
  EXPECT_EQ(state["contacts"], 1);
  EXPECT_EQ(state["stages"]["ccd_ms"], 1.5);
  EXPECT_EQ(state["account"]["impacts"], -1.25);
  EXPECT_TRUE(state["min_gap"].is_null());   // infinite
  EXPECT_TRUE(state["residual"].is_null());  // not a number
  EXPECT_EQ(state["speed"], 0.25);
  const auto gravity = state["effects"]["gravity"];
  EXPECT_EQ(gravity["on"], true);
  EXPECT_EQ(gravity["ms"], 0.25);
  EXPECT_EQ(gravity["set"]["key"], "gravity");
  EXPECT_EQ(gravity["set"]["on"], "[0, 0, -9.81]");
  EXPECT_EQ(gravity["why"], "declared at line 7");
  EXPECT_TRUE(state["effects"]["restitution"]["set"].is_null());
  ASSERT_EQ(state["knobs"].size(), 2u);
  EXPECT_EQ(state["knobs"][0]["low"], 1e-9);
  EXPECT_EQ(state["knobs"][1]["choices"], (std::vector<std::string>{"dantzig", "pgs"}));
  EXPECT_EQ(state["knobs"][1]["restarts"], true);
  course.failed = "energy\ngrew \xff";
  EXPECT_EQ(nlohmann::json::parse(state_text(scene, scene.snapshot(), course))["failed"],
            "energy\\x0agrew \uFFFD");
}

TEST(Messages, AnswersSayHowItWent) {
  const auto set = nlohmann::json::parse(answer_text({.text = "rebuilt", .rebuilt = true, .ms = 1.5}, false));
  EXPECT_EQ(set["ok"], true);
  EXPECT_EQ(set["text"], "rebuilt");
  EXPECT_EQ(set["restarted"], false);
  EXPECT_EQ(set["rebuilt"], true);
  EXPECT_EQ(set["ms"], 1.5);
  EXPECT_FALSE(set.contains("scene"));
  EXPECT_EQ(nlohmann::json::parse(answer_text({"a: 1\nb: 2\n"}, true))["scene"], "a: 1\nb: 2\n");
  const auto refused = nlohmann::json::parse(refusal_text("two\nlines"));
  EXPECT_EQ(refused["ok"], false);
  EXPECT_EQ(refused["text"], "two\\x0alines");
}

}  // namespace

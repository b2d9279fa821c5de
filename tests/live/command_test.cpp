// Commands read from JSON: what is accepted, what is refused and how, and that nothing else can happen.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/errors.hpp"
#include "common/live/command.hpp"

namespace {

using namespace fc;
using namespace fc::live;

std::string refusal(const std::string& json) {
  try {
    parse_command(json);
    return "accepted";
  } catch (const InputError& error) {
    return error.what();
  }
}

template <class Expected>
bool is(const std::string& json) {
  return std::holds_alternative<Expected>(parse_command(json));
}

TEST(Command, EachIsRead) {
  EXPECT_TRUE(is<command::Run>(R"({"do": "run"})"));
  EXPECT_TRUE(is<command::Pause>(R"({"do": "pause"})"));
  EXPECT_TRUE(is<command::Step>(R"({"do": "step"})"));
  EXPECT_TRUE(is<command::Reset>(R"({"do": "reset"})"));
  EXPECT_TRUE(is<command::Stop>(R"({"do": "stop"})"));
  EXPECT_TRUE(is<command::Drop>(R"({"do": "drop"})"));
  EXPECT_TRUE(is<command::Save>(R"({"do": "save"})"));
  const auto set =
      std::get<command::Set>(parse_command(R"({"do": "set", "key": "ccd.tolerance", "value": "1e-4"})"));
  EXPECT_EQ(set.key, "ccd.tolerance");
  EXPECT_EQ(set.value, "1e-4");
  EXPECT_FALSE(set.of_twin);
  EXPECT_TRUE(
      std::get<command::Set>(parse_command(R"({"do": "set", "key": "friction", "value": "1", "of": "twin"})"))
          .of_twin);
  EXPECT_TRUE(std::get<command::Twin>(parse_command(R"({"do": "twin", "on": true})")).on);
  EXPECT_FALSE(std::get<command::Twin>(parse_command(R"({"do": "twin", "on": false})")).on);
  const auto ball = std::get<command::Throw>(
      parse_command(R"({"do": "throw", "from": [1, 2.5, -3], "velocity": [0, 0, 9]})"));
  EXPECT_EQ(ball.from, Vec3(1, 2.5, -3));
  EXPECT_EQ(ball.velocity, Vec3(0, 0, 9));
  const auto grab =
      std::get<command::Grab>(parse_command(R"({"do": "grab", "body": 7, "point": [1, 2, 3]})"));
  EXPECT_EQ(grab.body, 7);
  EXPECT_EQ(grab.point, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<command::Drag>(parse_command(R"({"to": [1, 2, 3], "do": "drag"})")).to, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<command::Speed>(parse_command(R"({"do": "speed", "value": 0.25})")).value, 0.25);
}

TEST(Command, WhatIsNoneIsRefusedInALine) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "the command is not JSON"},
      {"run", "the command is not JSON"},
      {R"({"do": "run")", "the command is not JSON"},
      {R"({"do": "run"} {})", "the command is not JSON"},
      {R"({"do": "speed", "value": 1e999})", "the command is not JSON"},
      {R"(["run"])", R"(the command must be a JSON object, such as {"do": "run"})"},
      {"{}", "the command has no field 'do'"},
      {R"({"do": 3})", "'do' must be a text"},
      {R"({"do": "fly\n"})", R"(there is no command 'fly\x0a')"},
      {R"({"do": "run", "fast": true})", "'run' has no field 'fast'"},
      {R"({"do": "drag", "to": [1, 2, 3], "key": ""})", "'drag' has no field 'key'"},
      {R"({"do": "set", "key": "a"})", "the command has no field 'value'"},
      {R"({"do": "set", "key": "a", "value": 3})", "'value' must be a text"},
      {R"({"do": "set", "key": "a", "value": "3", "of": "scene"})",
       R"('of' must be "twin"; without it the key is of the scene)"},
      {R"({"do": "twin"})", "the command has no field 'on'"},
      {R"({"do": "twin", "on": 1})", "'on' must be true or false"},
      {R"({"do": "drag", "to": [1, 2]})", "'to' must be three finite numbers, [x, y, z]"},
      {R"({"do": "drag", "to": [1, 2, "3"]})", "'to' must be three finite numbers, [x, y, z]"},
      {R"({"do": "drag", "to": {"x": 1, "y": 2, "z": 3}})", "'to' must be three finite numbers, [x, y, z]"},
      {R"({"do": "grab", "body": -1, "point": [0, 0, 0]})", "'body' must be a whole number from 0 on"},
      {R"({"do": "grab", "body": 1.0, "point": [0, 0, 0]})", "'body' must be a whole number from 0 on"},
      {R"({"do": "grab", "body": 2147483648, "point": [0, 0, 0]})",
       "'body' must be a whole number from 0 on"},
      {R"({"do": "speed", "value": 2})", "'value' is 2, out of range (0, 1]: simulated seconds per second"},
      {R"({"do": "speed", "value": 0})", "'value' is 0, out of range (0, 1]: simulated seconds per second"},
      {R"({"do": "speed", "value": null})", "'value' must be a finite number"}};
  for (const auto& [json, why] : cases) EXPECT_EQ(refusal(json), why) << json;
}

TEST(Command, DeepNestingAndLongTextsAreRefused) {
  for (const char* opening : {"[", "{\"do\":"}) {
    std::string deep;
    while (deep.size() < 60000) deep += opening;
    EXPECT_EQ(refusal(deep), "the command is not JSON");
  }
  const std::string many(30000, '[');
  EXPECT_EQ(refusal(R"({"do": )" + many + std::string(30000, ']') + "}"), "'do' must be a text");
  EXPECT_LT(refusal(R"({"do": ")" + std::string(60000, 'x') + "\"}").size(), 100u);
}

// Whatever bytes come: a command whose numbers are finite, or an InputError of one line.
TEST(Command, TenThousandMalformedOnes) {
  const std::string good[] = {R"({"do": "set", "key": "ccd.tolerance", "value": "1e-4"})",
                              R"({"do": "throw", "from": [1, 2.5, -3e2], "velocity": [0, 0, 9]})",
                              R"({"do": "grab", "body": 7, "point": [1, 2, 3]})",
                              R"({"do": "speed", "value": 0.25})", R"({"do": "step"})"};
  const std::string pieces[] = {"1e308",   "-1e309",   "[[[", "null", "\"do\"",
                                "\\u0000", "\xff\xfe", "{}",  ",",    "99999999999999999999"};
  std::mt19937_64 random(20080101);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  int accepted = 0, refused = 0;
  for (int i = 0; i < 10000; ++i) {
    std::string json = good[below(std::size(good))];
    for (std::size_t change = below(4); change < 4; ++change) {
      if (json.empty()) break;
      const std::size_t at = below(json.size());
      switch (below(4)) {
        case 0:
          json[at] = static_cast<char>(below(256));
          break;
        case 1:
          json.erase(at, 1 + below(8));
          break;
        case 2:
          json.insert(at, pieces[below(std::size(pieces))]);
          break;
        default:
          json.resize(at);
          break;
      }
    }
    try {
      const Command command = parse_command(json);
      ++accepted;
      if (const auto* ball = std::get_if<command::Throw>(&command)) {
        EXPECT_TRUE(ball->from.allFinite() && ball->velocity.allFinite()) << json;
      }
      if (const auto* speed = std::get_if<command::Speed>(&command)) {
        EXPECT_TRUE(speed->value > 0 && speed->value <= 1) << json;
      }
    } catch (const InputError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << json;
    }
  }
  EXPECT_GT(accepted, 10);  // changes of a key's letters, for example
  EXPECT_GT(refused, 5000);
}

}  // namespace

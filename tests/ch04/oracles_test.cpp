// What is known of many impacts without simulating them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

// Galperin (2003): a heavy ball pushes a light one against a wall. If their masses are as 100^N, the number
// of impacts has the digits of pi. Every one of them has to be found, the last at almost no speed.
class Galperin : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(Galperin, CountsTheDigitsOfPi) {
  const auto [power, expected] = GetParam();
  const std::string mass = std::to_string(std::pow(100.0, power));
  auto world = make_world(
      "step: {dt: 0.25, duration: 40}\nccd: {tolerance: 1.0e-10}\nrestitution: 1\nshapes:\n"
      "  light: {sphere: {radius: 0.5}, mass: 1}\n  heavy: {sphere: {radius: 0.5}, mass: " +
      mass +
      "}\n  wall: {box: {size: [1, 4, 4]}}\nbodies:\n"
      "  - {shape: wall, static: true, position: [-0.5, 0, 0]}\n"
      "  - {shape: light, position: [1.5, 0, 0]}\n"
      "  - {shape: heavy, position: [3.5, 0, 0], velocity: [-1, 0, 0]}\n");
  const double start = kinetic_energy(world);
  const Events events = run_world(world, 0.25, 160);
  EXPECT_EQ(static_cast<int>(events.all.size()), expected);
  EXPECT_EQ(events.lost_time(), 0);
  EXPECT_NEAR(kinetic_energy(world), start, 1e-9 * start);
  expect_sound(events);
}

INSTANTIATE_TEST_SUITE_P(Powers, Galperin,
                         testing::Values(std::pair{0, 3}, std::pair{1, 31}, std::pair{2, 314},
                                         std::pair{3, 3141}, std::pair{4, 31415}),
                         [](const auto& power) { return "N" + std::to_string(power.param.first); });

// A hundred thousandth of a second decides: bodies on the path are hit, however fast and thin they are.
TEST(Bullets, NoneOfAThousandPassesTheWall) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&](double size) {
    return "[" + std::to_string(size * any(engine)) + ", " + std::to_string(size * any(engine)) + ", " +
           std::to_string(size * any(engine)) + "]";
  };
  std::string text =
      "step: {dt: 0.0166666, duration: 1}\nrestitution: 0.5\nshapes:\n"
      "  wall: {box: {size: [0.01, 20, 20]}}\n  bullet: {box: {size: [0.05, 0.05, 0.05]}, mass: "
      "0.1}\nbodies:\n"
      "  - {shape: wall, static: true, position: [0, 0, 0]}\n";
  for (int i = 0; i < 1000; ++i) {
    const double y = -4.8 + 0.3 * (i % 32), z = -4.8 + 0.3 * (i / 32);
    text += "  - {shape: bullet, position: [-2, " + std::to_string(y) + ", " + std::to_string(z) +
            "], velocity: [" + std::to_string(100 + 20 * any(engine)) + ", " +
            std::to_string(2 * any(engine)) + ", " + std::to_string(2 * any(engine)) +
            "], spin: " + vector(200) + ", orientation: [1, " + std::to_string(any(engine)) + ", " +
            std::to_string(any(engine)) + ", " + std::to_string(any(engine)) + "]}\n";
  }
  auto world = make_world(text);
  const Events events = run_world(world, 1.0 / 60, 6);
  EXPECT_GE(events.all.size(), 1000U);  // each hits it once at least
  for (int i = 1; i <= 1000; ++i)
    EXPECT_LT(body(world, i).position.x(), -0.005) << "bullet " << i << " is in or behind the wall";
  expect_sound(events);
}

// Two clouds of bullets that fly through each other: those that meet, meet.
TEST(Bullets, ThatMeetEachOtherDoNotPass) {
  std::string text =
      "step: {dt: 0.0166666, duration: 1}\nrestitution: 1\nshapes:\n"
      "  bullet: {sphere: {radius: 0.02}, mass: 0.1}\nbodies:\n";
  for (int i = 0; i < 100; ++i) {
    const std::string place = std::to_string(0.1 * (i % 10)) + ", " + std::to_string(0.1 * (i / 10)) + "]";
    text += "  - {shape: bullet, position: [-3, " + place + ", velocity: [500, 0, 0]}\n";
    text += "  - {shape: bullet, position: [3, " + place + ", velocity: [-500, 0, 0]}\n";
  }
  auto world = make_world(text);
  const Events events = run_world(world, 1.0 / 60, 2);
  EXPECT_EQ(events.all.size(), 100U);
  for (int i = 0; i < 200; ++i) EXPECT_NEAR(body(world, i).velocity.x(), i % 2 == 0 ? -500 : 500, 1e-9) << i;
}

// The closed form of two balls against the search, which does not use it: a capsule of almost no length.
// the name.
TEST(Balls, MeetWhenTheSearchSaysSo) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> any(-1, 1);
  int hits = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto number = [&](double size) { return std::to_string(size * any(engine)); };
    const std::string places = ", position: [" + number(0.8) + ", " + number(0.8) + ", " + number(0.8) +
                               "], velocity: [" + number(4) + ", " + number(4) + ", " + number(4) + "]}\n";
    const std::string scene =
        "step: {dt: 1, duration: 1}\nrestitution: 1\nshapes:\n  ball: {sphere: {radius: 0.4}, mass: 1}\n"
        "  pill: {capsule: {radius: 0.4, length: 1.0e-9}, mass: 1}\nbodies:\n  - {shape: ball, position: [5, "
        "0, 0], velocity: [-6, 0, 0]}\n";
    auto balls = make_world(scene + "  - {shape: ball" + places),
         pills = make_world(scene + "  - {shape: pill" + places);
    const Events a = run_world(balls, 1, 1), b = run_world(pills, 1, 1);
    ASSERT_EQ(a.all.size(), b.all.size()) << trial;
    for (std::size_t k = 0; k < a.all.size(); ++k) {
      EXPECT_NEAR(a.all[k].t, b.all[k].t, 1e-6) << trial;  // a tolerance's worth of distance
      EXPECT_NEAR((a.all[k].contact.normal - b.all[k].contact.normal).norm(), 0, 1e-4);
      EXPECT_NEAR(a.all[k].impulse.impulse, b.all[k].impulse.impulse, 1e-3);
      ++hits;
    }
  }
  EXPECT_GT(hits, 10);
}

// What happens in one corner queries no pair in another.
TEST(Cost, OfAnImpactDoesNotGrowWithBodiesFarAway) {
  const auto pairs_queried = [](int bystanders) {
    std::string text =
        "step: {dt: 0.01, duration: 1}\nrestitution: 1\nshapes:\n  ball: {sphere: {radius: 0.5}, mass: "
        "1}\nbodies:\n"
        "  - {shape: ball, position: [0, 0, 0], velocity: [1, 0, 0]}\n  - {shape: ball, position: [2, 0, 0], "
        "velocity: [-1, 0, 0]}\n";
    for (int i = 0; i < bystanders; ++i)
      text +=
          "  - {shape: ball, position: [" + std::to_string(10 + 3 * i) + ", 0, 0], velocity: [0, 1, 0]}\n";
    auto world = make_world(text);
    const Events events = run_world(world, 0.01, 100);
    EXPECT_EQ(events.all.size(), 1U);
    std::int64_t pairs = 0;
    for (const auto& report : events.reports) pairs += report.pairs;
    return pairs;
  };
  EXPECT_EQ(pairs_queried(0), pairs_queried(300));
}

}  // namespace

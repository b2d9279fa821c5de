// Collisions without gravity, against closed forms.
#include <gtest/gtest.h>

#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

TEST(HeadOn, TwoBallsOfAnyRestitution) {
  for (const double e : {0.0, 0.3, 0.7, 1.0}) {
    auto world = make_world(balls +
                                "  - {shape: ball, velocity: [2, 0, 0]}\n"
                                "  - {shape: heavy, position: [2.5, 0, 0], velocity: [-1, 0, 0]}\n",
                            {"restitution=" + std::to_string(e)});
    const Events events = run_world(world, 0.1, 10);
    ASSERT_EQ(events.all.size(), 1U) << e;
    EXPECT_NEAR(events.all[0].t, 0.5, 1e-9);
    EXPECT_LE(events.all[0].t, 0.5) << "never late";
    EXPECT_NEAR(events.all[0].impulse.impulse, 0.75 * (1 + e) * 3, 1e-12);  // reduced mass 3/4
    EXPECT_NEAR(events.all[0].impulse.v_before, -3, 1e-12);
    EXPECT_NEAR(body(world, 0).velocity.x(), ((1 - e * 3) * 2 + (1 + e) * 3 * -1) / 4, 1e-12);
    EXPECT_NEAR(body(world, 1).velocity.x(), ((3 - e) * -1 + (1 + e) * 2) / 4, 1e-12);
    EXPECT_NEAR(body(world, 0).position.x(), 1 + 0.5 * ((1 - e * 3) * 2 - (1 + e) * 3) / 4, 1e-8);
    EXPECT_LE((body(world, 0).velocity - Vec3(body(world, 0).velocity.x(), 0, 0)).norm(), 1e-9);
    EXPECT_EQ(events.lost_time(), 0);
    expect_sound(events);
  }
}

TEST(HeadOn, ASpeedOfAKilometrePerSecondIsNotMissed) {
  auto world = make_world(balls +
                          "  - {shape: ball, velocity: [1000, 0, 0]}\n"
                          "  - {shape: wall, static: true, position: [50.5, 0, 0]}\n");
  const Events events = run_world(world, 1.0, 1);  // ten times the distance in one frame
  ASSERT_EQ(events.all.size(), 1U);
  EXPECT_NEAR(events.all[0].t, 0.0495, 1e-9);
  EXPECT_NEAR(body(world, 0).velocity.x(), -1000, 1e-9);
}

// Newton's law for simultaneous impacts: -(n-2)/n for the first, 2/n for the others.
TEST(Cradle, OfThreeToFiveBalls) {
  for (const int n : {3, 4, 5}) {
    std::string text = balls + "  - {shape: ball, position: [-3, 0, 0], velocity: [6, 0, 0]}\n";
    for (int i = 1; i < n; ++i)
      text += "  - {shape: ball, position: [" + std::to_string(i - 1) + ", 0, 0]}\n";
    auto world = make_world(text);
    const Events events = run_world(world, 1.0 / 60, 60);
    ASSERT_EQ(events.instants, 1);
    EXPECT_EQ(events.all.size(), n - 1U) << "all contacts of the instant, together";
    EXPECT_NEAR(events.all[0].t, 1.0 / 3, 1e-9);
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(body(world, i).velocity.x(), i == 0 ? -6.0 * (n - 2) / n : 12.0 / n, 1e-9) << n << " " << i;
    EXPECT_NEAR(kinetic_energy(world), 18, 1e-9);
    expect_sound(events);
  }
}

TEST(Squeeze, IsSymmetric) {
  auto world = make_world(balls +
                          "  - {shape: ball, position: [-2, 0, 0], velocity: [1, 0, 0]}\n"
                          "  - {shape: ball}\n"
                          "  - {shape: ball, position: [2, 0, 0], velocity: [-1, 0, 0]}\n");
  const Events events = run_world(world, 0.1, 20);
  ASSERT_EQ(events.instants, 1);
  ASSERT_EQ(events.all.size(), 2U);
  EXPECT_NEAR(body(world, 0).velocity.x(), -1, 1e-12);
  EXPECT_NEAR(body(world, 1).velocity.x(), 0, 1e-12);
  EXPECT_NEAR(body(world, 2).velocity.x(), 1, 1e-12);
}

// An engine that solves one contact after the other may double the energy here.
TEST(BallAtAWall, SendsTheOtherBack) {
  auto world = make_world(balls +
                          "  - {shape: ball, position: [-3, 0, 0], velocity: [2, 0, 0]}\n"
                          "  - {shape: ball}\n"
                          "  - {shape: wall, static: true, position: [1, 0, 0]}\n");
  const Events events = run_world(world, 0.1, 20);
  ASSERT_EQ(events.instants, 1);
  ASSERT_EQ(events.all.size(), 2U);
  for (const Event& event : events.all) EXPECT_NEAR(event.impulse.impulse, 4, 1e-9);
  EXPECT_NEAR(body(world, 0).velocity.x(), -2, 1e-9);
  EXPECT_NEAR(body(world, 1).velocity.norm(), 0, 1e-9);
}

// Galperin: a heavy ball, a light one and a wall collide as often as pi has digits to count. No ball may be
// missed, and none counted twice.
TEST(Galperin, CountsTheDigitsOfPi) {
  for (const auto& [mass, count] : {std::pair{"1", 3}, std::pair{"100", 31}, std::pair{"10000", 314}}) {
    auto world = make_world(balls +
                                "  - {shape: wall, static: true, position: [-1, 0, 0]}\n"
                                "  - {shape: ball, position: [1, 0, 0]}\n"
                                "  - {shape: heavy, position: [3, 0, 0], velocity: [-1, 0, 0]}\n",
                            {std::string("shapes.heavy.mass=") + mass});
    const Events events = run_world(world, 0.25, 40);
    EXPECT_EQ(events.all.size(), count);
    EXPECT_EQ(events.instants, count);
    EXPECT_EQ(events.lost_time(), 0);
    EXPECT_NEAR(kinetic_energy(world), 0.5 * std::stod(mass), 1e-9 * std::stod(mass));
    EXPECT_GT(body(world, 2).velocity.x(), 0);
  }
}

TEST(BoxOnAWall, MeetsItFlatAtFourPoints) {
  auto world = make_world(balls +
                              "  - {shape: wall, static: true, position: [-1, 0, 0]}\n"
                              "  - {shape: brick, position: [1, 0, 0], velocity: [-2, 0.5, 0]}\n",
                          {"restitution=0.5"});
  const Events events = run_world(world, 0.1, 10);
  ASSERT_EQ(events.instants, 1);
  EXPECT_NEAR(events.all[0].t, 0.5, 1e-9);
  int rows = 0, contacts = 0;
  double impulse = 0;
  for (const auto& report : events.reports) rows += report.lcp_rows, contacts += report.contacts;
  for (const Event& event : events.all) impulse += event.impulse.impulse;
  EXPECT_EQ(rows, 4) << "one LCP";
  EXPECT_EQ(contacts, 4);
  EXPECT_NEAR(impulse, 2 * 2 * 1.5, 1e-12);
  EXPECT_LE((body(world, 1).velocity - Vec3(1, 0.5, 0)).norm(), 1e-12);
  EXPECT_LE(body(world, 1).spin.norm(), 1e-12);
}

// Box on edge: the closed form of a corner hit. v+ = -e v- at the point, spin about y.
TEST(RodOnAWall, TurnsAsItMust) {
  auto world = make_world(balls +
                              "  - {shape: wall, static: true, position: [-1, 0, 0]}\n"
                              "  - {shape: rod, position: [1, 0, 0.1], orientation: [0.9238795325112867, 0, "
                              "0.3826834323650898, 0], velocity: [-1, 0, 0]}\n",
                          {"shapes.rod={capsule: {radius: 0.1, length: 1}, mass: 2}", "restitution=0.25"});
  const fc::RigidBody rod = body(world, 1);
  const double inertia = rod.inertia_body(1, 1),
               lever = 0.5 * std::sqrt(0.5);  // the end that hits: below or above
  const Events events = run_world(world, 0.05, 30);
  ASSERT_EQ(events.all.size(), 1U);
  const double impulse = 1.25 * 1 / (1 / 2.0 + lever * lever / inertia);
  EXPECT_NEAR(events.all[0].impulse.impulse, impulse, 1e-9);
  EXPECT_NEAR(events.all[0].t, 1.5 - lever - 0.1, 1e-9);
  EXPECT_NEAR(body(world, 1).velocity.x(), -1 + impulse / 2, 1e-9);
  EXPECT_NEAR(std::abs(body(world, 1).spin.y()), impulse * lever / inertia, 1e-9);
  EXPECT_NEAR(events.all[0].impulse.v_after, 0.25, 1e-9);
}

TEST(MixedRestitution, APairTakesTheLarger) {
  auto world = make_world(balls +
                              "  - {shape: ball, velocity: [2, 0, 0]}\n"
                              "  - {shape: heavy, position: [2, 0, 0]}\n",
                          {"restitution=0.2", "shapes.heavy.restitution=0.6"});
  run_world(world, 0.1, 10);
  EXPECT_NEAR(body(world, 1).velocity.x() - body(world, 0).velocity.x(), 0.6 * 2, 1e-12);
}

}  // namespace

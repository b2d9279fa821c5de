// What breaks naive steppers, by name; and closed forms of many impacts.
#include <gtest/gtest.h>

#include <cmath>

#include "ch04_multibody_stepping/study/parts.hpp"
#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

// --- bounces ---

// A ball from 2 m, restitution 0.7: the k-th touch comes at t1 (1 + 2 (e + ... + e^(k-1))). A contact is reported
// half a tolerance early, so at the speed v by half the tolerance over v: that is below a nanosecond down to
// 5 cm/s, the fourteenth touch.
TEST(BouncingBall, TouchesInClosedForm) {
  auto world = make_world(
      "step: {dt: 0.0166666666666666, duration: 1}\nccd: {tolerance: 1.0e-10}\ngravity: [0, 0, "
      "-9.81]\nrestitution: 0.7\n"
      "shapes:\n  ball: {sphere: {radius: 0.5}, mass: 1}\n  floor: {box: {size: [4, 4, 1]}}\nbodies:\n"
      "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n  - {shape: ball, position: [0, 0, 2.5]}\n");
  const Events events = run_world(world, 1.0 / 60, 300);
  ASSERT_GE(events.all.size(), 20U);
  const double fall = std::sqrt(2 * 2 / 9.81);
  double time = fall, arc = 2 * fall;
  for (int k = 0; k < 14; ++k) {
    EXPECT_NEAR(events.all[static_cast<std::size_t>(k)].t, time, 1e-9) << "touch " << k;
    arc *= 0.7;
    time += arc;
  }
}

// A ball in a corridor, square to its walls: for ever the same, back and forth.
TEST(Billiard, ACorridorTakesTheSameTimeEachWay) {
  auto world = make_world(
      "step: {dt: 0.1, duration: 1}\nccd: {tolerance: 1.0e-10}\nrestitution: 1\n"
      "shapes:\n  ball: {sphere: {radius: 0.5}, mass: 1}\n  wall: {box: {size: [1, 40, 4]}}\nbodies:\n"
      "  - {shape: wall, static: true, position: [-2.5, 0, 0]}\n  - {shape: wall, static: true, position: "
      "[2.5, 0, 0]}\n"
      "  - {shape: ball, velocity: [3, 0.01, 0]}\n");
  const Events events = run_world(world, 0.1, 1000);  // a free path of 3 m: one hit a second
  ASSERT_EQ(events.all.size(), 100U);
  for (std::size_t k = 0; k < events.all.size(); ++k)
    EXPECT_NEAR(events.all[k].t, 0.5 + static_cast<double>(k), 1e-8) << "hit " << k;
  EXPECT_EQ(std::abs(body(world, 2).velocity.x()), 3);
}

// Three balls on a line that lose too much: they collapse, infinitely many impacts in a finite time (McNamara
// and Young). It is noticed, the guarantees hold, and everything else goes on.
TEST(Collapse, OfThreeBallsIsNoticed) {
  auto world = make_world(
      "step: {dt: 0.01, duration: 1}\nrestitution: 0.05\nshapes:\n  ball: {sphere: {radius: 0.5}, mass: "
      "1}\nbodies:\n"
      "  - {shape: ball, velocity: [2, 0, 0]}\n  - {shape: ball, position: [2, 0, 0]}\n"
      "  - {shape: ball, position: [4.3, 0, 0], velocity: [-2, 0, 0]}\n"
      "  - {shape: ball, position: [0, 9, 0], velocity: [1, 0, 0]}\n");
  const Events events = run_world(world, 0.01, 200);
  EXPECT_GT(events.all.size(), 4U);
  expect_sound(events);
  for (int i = 0; i < 2; ++i)
    EXPECT_GT((body(world, i + 1).position - body(world, i).position).norm(), 1)
        << "balls " << i << " and " << i + 1;
  EXPECT_NEAR(body(world, 3).position.x(), 2, 1e-12) << "who has nothing to do with it loses no time";
}

// A thousand impacts in a frame are no Zeno: nothing is lost.
TEST(Collapse, AThousandImpactsInAFrameAreNone) {
  auto world = make_world(
      "step: {dt: 0.5, duration: 1}\nccd: {tolerance: 1.0e-10}\nrestitution: 1\n"
      "shapes:\n  ball: {sphere: {radius: 0.5}, mass: 1}\n  heavy: {sphere: {radius: 0.5}, mass: 1000000}\n"
      "  wall: {box: {size: [1, 4, 4]}}\nbodies:\n"
      "  - {shape: wall, static: true, position: [-0.5, 0, 0]}\n  - {shape: ball, position: [1.5, 0, 0]}\n"
      "  - {shape: heavy, position: [2.6, 0, 0], velocity: [-1, 0, 0]}\n");
  int most = 0;
  double lost = 0;
  for (int frame = 0; frame < 20; ++frame) {
    const auto report = fc::world::step(world, 0.5);
    most = std::max(most, report.impacts);
    lost += report.lost_time;
  }
  EXPECT_GT(most, 1000);
  EXPECT_EQ(lost, 0);
}

// --- invariants over ten thousand impacts ---

TEST(Gas, KeepsItsEnergyOverTenThousandImpacts) {
  for (const auto kind : {fc::world::Kind::ball, fc::world::Kind::block, fc::world::Kind::hull}) {
    const int bodies = kind == fc::world::Kind::ball ? 500 : 125;
    auto world = fc::world::build_world(fc::world::gas(kind, bodies, 3));
    fc::world::Run run;
    int impacts = 0;
    const double before = kinetic_energy(world);
    while (impacts < (kind == fc::world::Kind::ball ? 10'000 : 3'000)) {
      run = fc::world::run_frames(world, 1.0 / 60, 30);
      impacts += run.sum.impacts;
      ASSERT_LE(run.sum.lcp_residual, 1e-13);
      ASSERT_EQ(run.sum.lost_time, 0);
    }
    EXPECT_NEAR(kinetic_energy(world), before, 1e-9 * before);
  }
}

// --- hard cases ---

TEST(Hard, MassRatioOfAHundredMillion) {
  for (const std::string heavy : {"a", "b"}) {
    auto world = make_world(
        "step: {dt: 0.01, duration: 1}\nrestitution: 1\nshapes:\n"
        "  a: {box: {size: [1, 1, 1]}, mass: " +
        std::string(heavy == "a" ? "1.0e8" : "1") +
        "}\n"
        "  b: {box: {size: [1, 1, 1]}, mass: " +
        std::string(heavy == "b" ? "1.0e8" : "1") +
        "}\nbodies:\n"
        "  - {shape: a, velocity: [1, 0, 0], orientation: [1, 0.1, 0.2, 0.3]}\n"
        "  - {shape: b, position: [3, 0.2, 0.1], velocity: [-1, 0, 0], spin: [1, 2, 3]}\n");
    const double before = kinetic_energy(world);
    const Events events = run_world(world, 0.01, 200);
    EXPECT_GT(events.all.size(), 0U);
    EXPECT_NEAR(kinetic_energy(world), before, 1e-12 * before);
    EXPECT_EQ(events.lost_time(), 0);
    expect_sound(events);
  }
}

// A rod of 1000 : 1 that turns 160 times a second: its tip makes 500 m/s.
TEST(Hard, AThinRodSpinsAtAThousandRadiansPerSecond) {
  auto world = make_world(
      "step: {dt: 0.0166666666666666, duration: 1}\nrestitution: 1\nshapes:\n"
      "  rod: {capsule: {radius: 0.0005, length: 1}, mass: 0.1}\n  ball: {sphere: {radius: 0.05}, mass: "
      "0.1}\nbodies:\n"
      "  - {shape: rod, spin: [1000, 0, 0]}\n  - {shape: ball, position: [0, 0.7, 0.1], velocity: [0, -2, "
      "0]}\n");
  const double before = kinetic_energy(world);
  const Events events = run_world(world, 1.0 / 60, 30);
  ASSERT_GT(events.all.size(), 0U);
  // The ball's near side enters the circle of the tips (0.5005 m) after about 0.075 s; the tip comes by every
  // 3 ms, in which the ball moves 6 mm.
  EXPECT_GT(events.all[0].t, 0.070);
  EXPECT_LT(events.all[0].t, 0.085);
  EXPECT_NEAR(kinetic_energy(world), before, 1e-11 * before);
  expect_sound(events);
}

TEST(Hard, TenKilometresFromTheOrigin) {
  const auto run = [](const Vec3& from) {
    const auto at = [&](double x, double y, double z) {
      return "[" + number(from.x() + x) + ", " + number(from.y() + y) + ", " + number(from.z() + z) + "]";
    };
    auto world = make_world(
        "step: {dt: 0.01, duration: 1}\nrestitution: 1\nshapes:\n  brick: {box: {size: [1, 0.8, 0.6]}, mass: "
        "2}\nbodies:\n"
        "  - {shape: brick, position: " +
        at(0, 0, 0) +
        ", velocity: [1, 0, 0], spin: [1, 2, 3]}\n"
        "  - {shape: brick, position: " +
        at(2, 0.25, 0.125) + ", velocity: [-1, 0, 0], spin: [0, 1, 0]}\n");
    const Events events = run_world(world, 0.01, 120);
    expect_sound(events);
    return std::pair(events.all, Vec3(body(world, 1).velocity));
  };
  const auto [near, near_end] = run({0, 0, 0});
  const auto [far, far_end] = run({8192, -8192, 8192});
  ASSERT_GT(near.size(), 0U);
  ASSERT_EQ(near.size(), far.size());
  EXPECT_NEAR(near[0].t, far[0].t, 1e-9);
  EXPECT_LE((near_end - far_end).norm(), 1e-6);
}

// Sixty-four balls fly to one point and touch all in the same instant: the eight corners of cubes within
// cubes are solved as one island.
TEST(Hard, SixtyFourBodiesMeetInOneInstant) {
  std::string text =
      "step: {dt: 0.25, duration: 1}\nrestitution: 1\nshapes:\n  ball: {sphere: {radius: 0.5}, mass: "
      "1}\nbodies:\n";
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z) {
        const Vec3 place(x - 1.5, y - 1.5,
                         z - 1.5);  // touching after they have come half a metre in in units
        const Vec3 start = 1.5 * place, velocity = -place;
        text += "  - {shape: ball, position: [" + number(start.x()) + ", " + number(start.y()) + ", " +
                number(start.z()) + "], velocity: [" + number(velocity.x()) + ", " + number(velocity.y()) +
                ", " + number(velocity.z()) + "]}\n";
      }
  auto world = make_world(text);
  const double before = kinetic_energy(world);
  const Events events = run_world(world, 0.25, 8);
  EXPECT_GE(events.all.size(), 100U);
  double first = events.all.front().t;
  int together = 0;
  for (const Event& event : events.all) together += event.t == first;
  EXPECT_GE(together, 90) << "the contacts of one instant are solved as one";
  EXPECT_NEAR(first, 0.5, 1e-5);
  EXPECT_NEAR(kinetic_energy(world), before, 1e-10 * before);
  expect_sound(events);
  Vec3 momentum = Vec3::Zero();
  for (const auto& b : world.bodies) momentum += b.state.momentum();
  EXPECT_LE(momentum.norm(), 1e-11);
}

// The contact falls onto the end of a frame, give or take rounding: it happens once, whatever the frames.
TEST(Hard, AContactAtAFramesVeryEnd) {
  for (const int frames : {1, 2, 3, 5, 7, 8, 16, 60, 64, 100}) {
    auto world = make_world(
        "step: {dt: 1, duration: 1}\nccd: {tolerance: 1.0e-9}\nrestitution: 1\nshapes:\n  ball: {sphere: "
        "{radius: 0.5}, mass: 1}\n"
        "bodies:\n  - {shape: ball, velocity: [1, 0, 0]}\n  - {shape: ball, position: [3, 0, 0], velocity: "
        "[-1, 0, 0]}\n");
    const Events events = run_world(world, 1.0 / frames, 2 * frames);  // they touch at t = 1
    ASSERT_EQ(events.all.size(), 1U) << frames;
    EXPECT_NEAR(events.all[0].t, 1, 1e-8) << frames;
    EXPECT_NEAR(body(world, 0).position.x(), 0, 1e-8) << frames;
  }
}

TEST(Hard, OneBodyAndNone) {
  const std::string head =
      "step: {dt: 0.1, duration: 1}\ngravity: [0, 0, -10]\nshapes:\n  ball: {sphere: {radius: 0.5}, mass: "
      "1}\nbodies:";
  auto one = make_world(head + "\n  - {shape: ball}\n");
  run_world(one, 0.1, 10);
  EXPECT_NEAR(body(one, 0).position.z(), -5, 1e-12);
  auto none = fc::world::build_world(fc::Scene());  // a scene file without bodies is refused
  const Events events = run_world(none, 0.1, 10);
  EXPECT_TRUE(events.all.empty());
  EXPECT_EQ(events.lost_time(), 0);
}

// A tolerance that rounding could not keep is raised to one that it can, and the world still works.
TEST(Hard, AToleranceBelowRoundingIsRaised) {
  const std::string scene =
      "step: {dt: 0.1, duration: 1}\nrestitution: 1\nshapes:\n  brick: {box: {size: [1, 1, 1]}, mass: "
      "1}\nbodies:\n"
      "  - {shape: brick, velocity: [1, 0, 0], spin: [0, 0, 1]}\n  - {shape: brick, position: [2.5, 0.1, "
      "0.2]}\n";
  auto world = make_world("ccd: {tolerance: 1.0e-15}\n" + scene), usual = make_world(scene);
  EXPECT_GT(world.tolerance, 1e-14);
  EXPECT_LT(world.tolerance, 1e-9);
  EXPECT_EQ(usual.tolerance, 1e-6);
  const Events a = run_world(world, 0.1, 30), b = run_world(usual, 0.1, 30);
  ASSERT_EQ(a.all.size(), b.all.size());
  ASSERT_GT(a.all.size(), 0U);
  EXPECT_NEAR(a.all[0].t, b.all[0].t, 1e-5);
  expect_sound(a);
}

// Bullets at the edges of a wall, and past them: those that meet it are sent back, the others fly on.
TEST(Bullets, AtTheEdgesOfAWall) {
  std::string text =
      "step: {dt: 0.0166666, duration: 1}\nrestitution: 1\nshapes:\n  wall: {box: {size: [0.01, 4, 4]}}\n"
      "  bullet: {sphere: {radius: 0.025}, mass: 0.1}\nbodies:\n  - {shape: wall, static: true}\n";
  for (int i = 0; i < 100; ++i)
    text += "  - {shape: bullet, position: [-2, " + number(1.9 + 0.002 * i) + ", " +
            number(-1.9 + 0.06 * (i % 50)) + "], velocity: [100, 0, 0]}\n";
  auto world = make_world(text);
  run_world(world, 1.0 / 60, 6);
  for (int i = 0; i < 100; ++i) {
    const double edge = 1.9 + 0.002 * i, x = body(world, i + 1).position.x();
    // A bullet whose middle is within its radius of the wall's edge touches it, and one that is farther does
    // not.
    if (edge < 2.024) {
      EXPECT_TRUE(body(world, i + 1).velocity.x() < 99.9)
          << "bullet " << i << " at " << edge << " m met the wall";
    }
    if (edge < 2) {
      EXPECT_LT(x, -0.02) << "bullet " << i << " passed the wall";
    }
    if (edge > 2.026) {
      EXPECT_NEAR(x, 8, 0.01) << "bullet " << i << " flew past, and was stopped by nothing";
    }
  }
}

}  // namespace

// Bodies that move by themselves, sensors and sleep against what is known of them; and what is off.
#include <gtest/gtest.h>

#include <cmath>

#include "events.hpp"

namespace {

using namespace fc_test;

// --- kinematic ---

const std::string piston = R"(
step: {dt: 0.01, duration: 1}
ccd: {tolerance: 1.0e-9}
restitution: 0.5
shapes:
  ball: {sphere: {radius: 0.5}, mass: 2}
  wall: {box: {size: [1, 4, 4]}}
bodies:
  - {shape: wall, kinematic: true, velocity: [3, 0, 0]}
)";

// A wall at u = 3 m/s hits a ball at rest: v = (1 + e) u = 4.5 m/s, and does m v^2/2 = 20.25 J + lost energy
// of work: impulse times u, 9 N s * 3 m/s = 27 J.
TEST(Kinematic, APistonPushesABall) {
  auto world = make_world(piston + "  - {shape: ball, position: [2, 0, 0]}\n");
  const Events events = run_world(world, 0.01, 100);
  ASSERT_EQ(events.all.size(), 1U);
  EXPECT_NEAR(events.all[0].t, 1.0 / 3, 1e-9);
  EXPECT_NEAR(body(world, 1).velocity.x(), 4.5, 1e-12);
  EXPECT_EQ(body(world, 0).velocity.x(), 3);
  EXPECT_NEAR(body(world, 0).position.x(), 3, 1e-12);
  double work = 0, error = 0, gain = 0;
  for (const auto& report : events.reports) {
    work += report.kinematic_work;
    error = std::max(error, report.energy_error);
    gain = std::max(gain, report.energy_gain);
  }
  EXPECT_NEAR(work, 27, 1e-9);
  EXPECT_LE(error, 1e-9);
  EXPECT_LE(gain, 0);
}

// What is impossible is reported, not guessed: a ball between a piston and a wall that do not give way.
TEST(Kinematic, ASqueezeIsReported) {
  auto world = make_world(
      "step: {dt: 0.01, duration: 1}\nshapes:\n  ball: {sphere: {radius: 0.5}, mass: 2}\n"
      "  wall: {box: {size: [1, 4, 4]}}\nbodies:\n"
      "  - {shape: wall, kinematic: true, velocity: [3, 0, 0]}\n"
      "  - {shape: ball, position: [2, 0, 0]}\n"
      "  - {shape: wall, static: true, position: [3.2, 0, 0]}\n");
  bool refused = false;
  try {
    const Events events = run_world(world, 0.01, 100);
    // Or the ball is frozen where it is, and the piston stops for it: neither overlaps.
    EXPECT_GT(events.lost_time(), 0);
  } catch (const fc::NumericalFailure&) {
    refused = true;
  }
  const double ball = body(world, 1).position.x(), wall = body(world, 0).position.x();
  if (!refused) {
    EXPECT_GT(ball - wall, 1) << "the piston has entered the ball";
  }
}

// Kinematic and static bodies pass through each other: neither can give way.
TEST(Kinematic, IsNotQueriedAboutWhatCannotYield) {
  auto world = make_world(piston +
                          "  - {shape: wall, static: true, position: [2, 0, 0]}\n"
                          "  - {shape: wall, kinematic: true, position: [3, 0, 0], spin: [0, 0, 1]}\n");
  const Events events = run_world(world, 0.01, 100);
  EXPECT_EQ(events.all.size(), 0U);
  for (const auto& report : events.reports) EXPECT_EQ(report.pairs, 0);
}

// A paddle turns by its own spin, and hits what is there: the ball leaves at (1 + e) times the speed of its
// point.
TEST(Kinematic, ATurningPaddleHitsABall) {
  auto world = make_world(R"(
step: {dt: 0.01, duration: 1}
ccd: {tolerance: 1.0e-9}
restitution: 1
shapes:
  ball: {sphere: {radius: 0.1}, mass: 2}
  paddle: {box: {size: [4, 0.2, 1]}}
bodies:
  - {shape: paddle, kinematic: true, spin: [0, 0, 2]}
  - {shape: ball, position: [1.5, 0.7, 0]}
)");
  const Events events = run_world(world, 0.01, 50);
  ASSERT_GE(events.all.size(), 1U);
  const auto& contact = events.all[0].contact;
  const double arm = std::hypot(contact.point.x(), contact.point.y());
  const double along_n =
      std::abs(2 * (contact.point.x() * contact.normal.y() - contact.point.y() * contact.normal.x()));
  EXPECT_LT(along_n, 2 * arm);
  EXPECT_NEAR(body(world, 1).velocity.norm(), 2 * along_n, 1e-9);
}

// --- sensors ---

const std::string gate = R"(
step: {dt: 0.01, duration: 2}
ccd: {tolerance: 1.0e-9}
shapes:
  ball: {sphere: {radius: 0.5}, mass: 2}
  gate: {box: {size: [1, 4, 4]}}
bodies:
  - {shape: ball, position: [-3, 0, 0], velocity: [2, 0, 0]}
)";

struct Seen {
  std::vector<double> times;
  std::vector<fc::world::Sighting> all;
};
Seen watch(fc::world::World& world, double dt, int frames) {
  Seen seen;
  for (int frame = 0; frame < frames; ++frame)
    fc::world::step(world, dt, {.sighting = [&](const fc::world::Sighting& s) {
                      seen.times.push_back(frame * dt + s.time);
                      seen.all.push_back(s);
                    }});
  return seen;
}

// It comes into the gate's reach after 2 m, at 1 s; and is not disturbed.
TEST(Sensor, SeesWhatComesAndPushesNothing) {
  auto world = make_world(gate + "  - {shape: gate, static: true, sensor: true}\n");
  const Seen seen = watch(world, 0.01, 400);
  ASSERT_EQ(seen.all.size(), 1U);
  EXPECT_NEAR(seen.times[0], 1, 1e-9);
  EXPECT_EQ(seen.all[0].sensor, 1);
  EXPECT_EQ(seen.all[0].body, 0);
  EXPECT_NEAR(seen.all[0].normal.x(), -1, 1e-6);
  EXPECT_NEAR(seen.all[0].speed, -2, 1e-6);
  EXPECT_NEAR(body(world, 0).position.x(), 5, 1e-11);
  EXPECT_EQ(body(world, 0).velocity.x(), 2);
}

// A wall behind the gate sends the ball back: it is seen once more, since it was apart in between.
TEST(Sensor, SeesAgainWhatHasLeft) {
  auto world = make_world("restitution: 1\n" + gate +
                          "  - {shape: gate, static: true, sensor: true}\n"
                          "  - {shape: gate, static: true, position: [4, 0, 0]}\n");
  const Seen seen = watch(world, 0.01, 500);  // there at 1 s, off the wall at 3 s, back in at 4 s
  ASSERT_EQ(seen.times.size(), 2U);
  EXPECT_NEAR(seen.times[0], 1, 1e-9);
  EXPECT_NEAR(seen.times[1], 4, 1e-6);
}

// Something that is inside from the start is seen at once, and no error.
TEST(Sensor, SeesWhatIsInside) {
  auto world = make_world(gate + "  - {shape: gate, static: true, sensor: true, position: [-3, 0, 0]}\n");
  const Seen seen = watch(world, 0.01, 10);
  ASSERT_EQ(seen.times.size(), 1U);
  EXPECT_EQ(seen.times[0], 0);
}

// Two sensors see each other, and one that moves sees what stands still.
TEST(Sensor, ThatMoves) {
  auto world = make_world(
      gate +
      "  - {shape: gate, kinematic: true, sensor: true, position: [9, 0, 0], velocity: [-1, 0, 0]}\n"
      "  - {shape: gate, static: true, position: [5, 0, 0]}\n");
  const Seen seen = watch(world, 0.01, 400);
  ASSERT_EQ(seen.all.size(), 1U);  // the wall at 3 s; the ball is still on its way
  EXPECT_NEAR(seen.times[0], 3, 1e-9);
  EXPECT_EQ(seen.all[0].body, 2);
}

// --- sleep ---

const std::string asleep = R"(
step: {dt: 0.01, duration: 2}
gravity: [0, 0, -10]
sleep: {after: 0.2, speed: 0.01}
shapes:
  ball: {sphere: {radius: 0.5}, mass: 2}
  block: {box: {size: [1, 1, 1]}, mass: 1}
  floor: {box: {size: [20, 20, 1]}}
bodies:
  - {shape: floor, static: true, position: [0, 0, -0.5]}
  - {shape: block, position: [0, 0, 0.5]}
  - {shape: block, position: [0, 0, 1.5]}
)";

TEST(Sleep, WhatLiesStillCostsNothing) {
  auto world = make_world(asleep);
  run_world(world, 0.01, 100);
  EXPECT_TRUE(world.bodies[1].asleep);
  EXPECT_TRUE(world.bodies[2].asleep);
  const Events events = run_world(world, 0.01, 100);
  std::int64_t pairs = 0, queries = 0;
  for (const auto& report : events.reports) {
    pairs += report.pairs;
    queries += report.queries;
  }
  EXPECT_EQ(pairs, 0);
  EXPECT_EQ(queries, 0);
  EXPECT_EQ(events.lost_time(), 0);
  EXPECT_EQ(body(world, 2).velocity.norm(), 0);
}

// A ball hits the lower block: both wake, the upper one too, since its support may be gone. (They turn on
// their edges then, in contact: that is frozen, and chapter 5's to move.)
TEST(Sleep, WhatIsHitWakesAndWhatLiesOnIt) {
  auto world = make_world(asleep + "  - {shape: ball, position: [-9.2, 0, 0.6], velocity: [8, 0, 5.2]}\n");
  int wakes = 0, falls = 0;
  for (int frame = 0; frame < 200; ++frame) {
    const auto report = fc::world::step(world, 0.01);
    wakes += report.wakes;
    falls += report.falls_asleep;
  }
  EXPECT_GE(falls, 2);
  EXPECT_GE(wakes, 2);
  EXPECT_GT(body(world, 1).velocity.x(), 1) << "it was hit";
}

// On something that moves nothing sleeps: it may sink away.
TEST(Sleep, NothingSleepsOnALift) {
  std::string text = asleep;
  text.replace(text.find("static: true"), 12, "kinematic: true, velocity: [0, 0, -0.1]");
  auto world = make_world(text);
  run_world(world, 0.01, 100);
  EXPECT_FALSE(world.bodies[1].asleep);
  EXPECT_LT(body(world, 1).position.z(), 0.42);
}

// --- what is off ---

// Balls that no friction turns have rows without an angular part; a brick among them does.
TEST(Rotation, IsDerived) {
  const std::string
      ball = "shapes:\n  ball: {sphere: {radius: 0.5}, mass: 1}\n  box: {box: {size: [1, 1, 1]}, mass: 1}\n",
      head = "step: {dt: 0.01, duration: 1}\n" + ball + "bodies:\n";
  EXPECT_FALSE(make_world(head + "  - {shape: ball}\n  - {shape: box, static: true, position: [3, 0, 0]}\n")
                   .effects.rotation);
  EXPECT_TRUE(
      make_world(head + "  - {shape: ball}\n  - {shape: box, position: [3, 0, 0]}\n").effects.rotation);
}

// An effect with a neutral value moves every body along the same path, bit by bit; an effect that is absent computes
// nothing, as always.
TEST(Off, NeutralEffectsChangeNoBit) {
  const std::string things =
      "step: {dt: 0.01, duration: 1}\nrestitution: 0.5\nshapes:\n  block: {box: {size: [1, 0.8, 0.6]}, mass: "
      "1}\n"
      "bodies:\n  - {shape: block, spin: [1, 2, 3]}\n  - {shape: block, position: [2, 0.1, 0], velocity: "
      "[-3, 0, 0]}\n";
  auto plain = make_world(things), neutral = make_world("drag: {linear: 0}\nsleep: {after: 1}\n" + things);
  const Events a = run_world(plain, 0.01, 100), b = run_world(neutral, 0.01, 100);
  ASSERT_EQ(a.all.size(), b.all.size());
  ASSERT_GT(a.all.size(), 0U);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(body(plain, i).position, body(neutral, i).position);
    EXPECT_EQ(body(plain, i).spin, body(neutral, i).spin);
  }
  for (std::size_t k = 0; k < a.reports.size(); ++k) {
    EXPECT_EQ(a.reports[k].lcp_rows, b.reports[k].lcp_rows);
    EXPECT_EQ(a.reports[k].queries, b.reports[k].queries);
    EXPECT_EQ(a.reports[k].node_pairs, b.reports[k].node_pairs);
  }
}

}  // namespace

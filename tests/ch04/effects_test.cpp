// Each effect against what is known of it in closed form, or against an independent integration.
#include <gtest/gtest.h>

#include <cmath>

#include "events.hpp"
#include "support/euler_integrator.hpp"

namespace {

using namespace fc_test;
using fc::Mat3;
using fc::Vec3;

// --- gyroscopic ---

const std::string brick = R"(
step: {dt: 0.0166666666666666, duration: 10}
gyroscopic: true
shapes:
  brick: {box: {size: [3, 2, 1]}, mass: 12}
bodies:
)";

// A brick that spins about its middle axis, almost, turns over again and again (Dzhanibekov).
TEST(Gyroscopic, TheMiddleAxisAgainstAnIntegration) {
  auto world = make_world(brick + "  - {shape: brick, spin: [0.01, 5, 0.02], velocity: [1, 2, 3]}\n");
  // 12/12 (b^2 + c^2): moments of the box about x, y, z
  fc::test::EulerIntegrator<long double> exact({5, 10, 13}, Eigen::Matrix<long double, 3, 3>::Identity(),
                                               {0.01L, 5, 0.02L});
  const double energy_at_start = kinetic_energy(world);
  const Vec3 momentum_at_start = body(world, 0).inertia_world() * body(world, 0).spin;
  int flips = 0;
  double last = 1;
  for (int frame = 1; frame <= 1200; ++frame) {
    fc::world::step(world, 1.0 / 60);
    exact.run(1.0L / 60);
    const Mat3 ours = body(world, 0).orientation.toRotationMatrix();
    ASSERT_LE((ours - exact.rotation().cast<double>()).norm(), 1e-9) << "in frame " << frame;
    const double along = ours.col(1).y();
    if (along * last < 0) ++flips;
    last = along;
  }
  EXPECT_GE(flips, 4);
  EXPECT_NEAR(kinetic_energy(world), energy_at_start, 1e-13 * energy_at_start);
  const Vec3 momentum = body(world, 0).inertia_world() * body(world, 0).spin;
  EXPECT_LE((momentum - momentum_at_start).norm(), 1e-12 * momentum_at_start.norm());
}

// Frames are for viewers: their length has no influence, also on a body that tumbles.
TEST(Gyroscopic, TheFramesLengthDoesNotMatter) {
  const std::string bodies =
      "  - {shape: brick, spin: [0.5, 5, 1], position: [0, 0, 0]}\n"
      "  - {shape: brick, spin: [3, -1, 2], position: [6, 0.3, 0], velocity: [-4, 0, 0]}\n";
  auto coarse = make_world("restitution: 1\n" + brick + bodies),
       fine = make_world("restitution: 1\n" + brick + bodies);
  const Events a = run_world(coarse, 0.5, 4), b = run_world(fine, 0.01, 200);
  ASSERT_GT(a.all.size(), 0U);
  ASSERT_EQ(a.all.size(), b.all.size());
  EXPECT_NEAR(a.all[0].t, b.all[0].t, 1e-6);
  EXPECT_LE((body(coarse, 0).position - body(fine, 0).position).norm(), 1e-4);
}

// Bodies that tumble freely keep all three: momentum, angular momentum and, at restitution 1, energy.
TEST(Gyroscopic, ImpactsOfTumblingBodiesKeepWhatIsToBeKept) {
  std::string text = "restitution: 1\n" + brick;
  for (int i = 0; i < 8; ++i)
    text += "  - {shape: brick, position: [" + std::to_string(4 * (i % 2)) + ", " +
            std::to_string(4 * (i / 2 % 2)) + ", " + std::to_string(4 * (i / 4)) + "], velocity: [" +
            std::to_string(i % 2 ? -3 : 3) + ", " + std::to_string(i / 2 % 2 ? -2 : 2) + ", " +
            std::to_string(i / 4 ? -2 : 2) + "], spin: [" + std::to_string(i) + ", 3, " +
            std::to_string(2 - i) + "]}\n";
  auto world = make_world(text);
  const auto momenta = [&] {
    std::pair<Vec3, Vec3> sum{Vec3::Zero(), Vec3::Zero()};
    for (const auto& b : world.bodies) {
      sum.first += b.state.momentum();
      sum.second += b.state.angular_momentum();
    }
    return sum;
  };
  const double energy_at_start = kinetic_energy(world);
  const auto at_start = momenta();
  const Events events = run_world(world, 1.0 / 60, 60);
  EXPECT_GT(events.all.size(), 10U);
  EXPECT_EQ(events.lost_time(), 0);
  EXPECT_NEAR(kinetic_energy(world), energy_at_start, 1e-11 * energy_at_start);
  EXPECT_LE((momenta().first - at_start.first).norm(), 1e-10);
  EXPECT_LE((momenta().second - at_start.second).norm(), 1e-9);
  expect_sound(events);
}

// Where a tumbling brick meets a wall, against dense sampling of the independent integration.
TEST(Gyroscopic, ATumblingBrickMeetsTheWallWhenItsFirstCornerDoes) {
  auto world = make_world(brick + "  - {shape: brick, spin: [4, 0.3, 0.2], velocity: [2, 0, 0]}\n" +
                          "  - {shape: brick, position: [6, 0, 0], static: true}\n");
  const Events events = run_world(world, 1.0 / 60, 240);
  ASSERT_GT(events.all.size(), 0U);
  fc::test::EulerIntegrator<double> exact({5, 10, 13}, Mat3::Identity(), {4, 0.3, 0.2});
  const auto foremost = [&](double t) {
    const Mat3 r = exact.rotation();
    return 2 * t + 1.5 * std::abs(r(0, 0)) + std::abs(r(0, 1)) + 0.5 * std::abs(r(0, 2));
  };
  double t = 0;
  const double step = 1e-5;
  while (foremost(t) < 4.5 && t < 4) {
    exact.run(step);
    t += step;
  }
  EXPECT_LE(events.all[0].t, t);
  EXPECT_GE(events.all[0].t, t - 2 * step);
}

// --- drag ---

// dv/dt = g - k v from rest: v = (g/k)(1 - e^-kt), and 9 m/s in the end.
TEST(Drag, FallsToItsTerminalVelocity) {
  auto world = make_world(R"(
step: {dt: 0.01, duration: 1}
gravity: [0, 0, -9]
drag: {linear: 1}
shapes:
  ball: {sphere: {radius: 0.5}, mass: 1}
bodies:
  - {shape: ball, velocity: [3, 0, 0]}
)");
  for (int frame = 1; frame <= 2000; ++frame) {
    fc::world::step(world, 0.01);
    const double t = 0.01 * frame, fallen = 9 * (t - 1 + std::exp(-t));
    ASSERT_NEAR(body(world, 0).velocity.z(), -9 * (1 - std::exp(-t)), 1e-11);
    ASSERT_NEAR(body(world, 0).position.z(), -fallen, 1e-11 * (1 + fallen));
    ASSERT_NEAR(body(world, 0).position.x(), 3 * (1 - std::exp(-t)), 1e-11);
  }
}

// A ball, and a capsule without length that the search of chapter 2 has to find, on a floor.
TEST(Drag, TheTimeOfAnImpactOnTheFloor) {
  for (const std::string shape :
       {"{sphere: {radius: 0.5}, mass: 1}", "{capsule: {radius: 0.5, length: 1.0e-9}, mass: 1}",
        "{box: {size: [1, 1, 1]}, mass: 1}"}) {
    auto world = make_world(
        "step: {dt: 0.01, duration: 1}\nccd: {tolerance: 1.0e-10}\ngravity: [0, 0, -9]\ndrag: {linear: 1}\n"
        "shapes:\n  thing: " +
        shape +
        "\n  floor: {box: {size: [9, 9, 1]}}\nbodies:\n"
        "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n  - {shape: thing, position: [0, 0, "
        "2.5]}\n");
    const Events events = run_world(world, 0.25, 4);
    ASSERT_GT(events.all.size(), 0U) << shape;
    double low = 0, high = 2;  // 9 (t - 1 + e^-t) = 2
    for (int i = 0; i < 100; ++i) {
      const double t = 0.5 * (low + high);
      (9 * (t - 1 + std::exp(-t)) < 2 ? low : high) = t;
    }
    EXPECT_NEAR(events.all[0].t, low, 1e-9) << shape;
    EXPECT_LE(events.all[0].t, low) << shape;
  }
}

TEST(Drag, TwoBallsMeetInClosedFormAsInTheSearch) {
  const auto run = [](const std::string& shape) {
    auto world = make_world(
        "step: {dt: 0.1, duration: 1}\ngravity: [0, 1, -9]\ndrag: {linear: 0.7, angular: 2}\nrestitution: 1\n"
        "shapes:\n  thing: " +
        shape +
        "\nbodies:\n  - {shape: thing, velocity: [1, 0, 2], spin: [1, 2, 3]}\n"
        "  - {shape: thing, position: [3, 0.2, 0.4], velocity: [-4, 0, 1], spin: [0, 5, 0]}\n");
    return run_world(world, 0.1, 20).all;
  };
  const auto balls = run("{sphere: {radius: 0.5}, mass: 1}"),
             pills = run("{capsule: {radius: 0.5, length: 1.0e-9}, mass: 1}");
  ASSERT_EQ(balls.size(), 1U);
  ASSERT_EQ(pills.size(), 1U);
  EXPECT_NEAR(balls[0].t, pills[0].t, 1e-6);
  // On a straight line 3 m apart drag stops them before they meet: 5 m/s / (2.5/s) = 2 m.
  auto never = make_world(
      "step: {dt: 10, duration: 10}\ndrag: {linear: 2.5}\nshapes:\n  ball: {sphere: {radius: 0.4}, mass: 1}\n"
      "bodies:\n  - {shape: ball}\n  - {shape: ball, position: [3, 0, 0], velocity: [-5, 0, 0]}\n");
  EXPECT_EQ(run_world(never, 10, 10).all.size(), 0U);
  EXPECT_NEAR(body(never, 1).position.x(), 1, 1e-12);
}

// The same tumbling, slower and slower: after t the body is where it would be after (1 - e^-kt)/k without.
TEST(Drag, OfATumblingBrickIsATimeThatSlowsDown) {
  const std::string tumbling = "  - {shape: brick, spin: [0.3, 5, 0.2]}\n";
  auto braked = make_world("drag: {angular: 0.5}\n" + brick + tumbling), free = make_world(brick + tumbling);
  for (int frame = 0; frame < 200; ++frame) fc::world::step(braked, 0.01);
  fc::world::step(free, (1 - std::exp(-1.0)) / 0.5);
  EXPECT_LE(
      (body(braked, 0).orientation.toRotationMatrix() - body(free, 0).orientation.toRotationMatrix()).norm(),
      1e-11);
  EXPECT_LE((body(braked, 0).spin - std::exp(-1.0) * body(free, 0).spin).norm(), 1e-11);
}

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

// What cannot be is said, not guessed: a ball between a piston and a wall that do not give way.
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
    // Or the ball is held where it is, and the piston stops for it: neither overlaps.
    EXPECT_GT(events.lost_time(), 0);
  } catch (const fc::NumericalFailure&) {
    refused = true;
  }
  const double ball = body(world, 1).position.x(), wall = body(world, 0).position.x();
  if (!refused) {
    EXPECT_GT(ball - wall, 1) << "the piston has entered the ball";
  }
}

// Kinematic and static bodies pass through each other: nobody can yield.
TEST(Kinematic, IsNotAskedAboutWhatCannotYield) {
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
// their edges then, in contact: that is held, and chapter 5's to move.)
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

// A neutral value of an effect moves every body along the same path, bit by bit; and the effect's absence, as
// ever, computes nothing of it.
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

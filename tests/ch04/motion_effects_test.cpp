// The effects on motions, torque-free rotation and drag, against closed forms or an independent integration.
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

}  // namespace

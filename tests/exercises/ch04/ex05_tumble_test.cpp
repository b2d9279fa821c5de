// Exercise 4.5. What is kept is kept to rounding; the rest is compared with chapter 1's closed form.
#include "ex05_tumble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ch04_multibody_stepping/torque_free.hpp"

namespace {

using fc::Mat3;
using fc::Vec3;
using fc::exercises::step;
using fc::exercises::Tumbler;

Tumbler tumbler(const Vec3& spin) {
  Tumbler body;
  body.moments = {5, 10, 13};
  body.momentum = body.moments.cwiseProduct(spin);
  return body;
}
double energy(const Tumbler& body) {
  return 0.5 * body.momentum.dot(body.momentum.cwiseQuotient(body.moments));
}

double error_after(double seconds, int steps) {
  const Vec3 spin(0.8, 2, 0.5);
  Tumbler body = tumbler(spin);
  for (int k = 0; k < steps; ++k) step(body, seconds / steps);
  const fc::world::TorqueFree exact(Mat3(body.moments.asDiagonal()), Mat3::Identity(), spin);
  return (body.rotation - exact.rotation_at(seconds)).norm();
}

TEST(Ex05Tumble, KeepsEnergyAndAngularMomentum) {
  Tumbler body = tumbler({0.8, 2, 0.5});
  const double energy_before = energy(body), size_before = body.momentum.norm();
  for (int k = 0; k < 10'000; ++k) step(body, 0.05);
  EXPECT_NEAR(energy(body), energy_before, 1e-12 * energy_before)
      << "J after 10,000 steps: nothing acts on the body, so its energy stays";
  EXPECT_NEAR(body.momentum.norm(), size_before, 1e-12 * size_before)
      << "kg m^2/s after 10,000 steps: |L| stays, for no torque acts";
}

TEST(Ex05Tumble, KeepsTheAngularMomentumInTheWorld) {
  Tumbler body = tumbler({0.8, 2, 0.5});
  const Vec3 before = body.rotation * body.momentum;
  for (int k = 0; k < 2000; ++k) step(body, 0.05);
  EXPECT_LE((body.rotation * body.momentum - before).norm(), 1e-11 * before.norm())
      << "kg m^2/s: no torque acts, so L may not move in the world";
  EXPECT_LE((body.rotation.transpose() * body.rotation - Mat3::Identity()).norm(), 1e-11)
      << "of R'R less 1: the rotation is none any more, the body would be stretched";
}

TEST(Ex05Tumble, IsOfSecondOrder) {
  const double coarse = error_after(4, 100), fine = error_after(4, 200), finer = error_after(4, 400);
  EXPECT_LE(finer, 1e-3) << "error of the rotation matrix after 4 s in 400 steps";
  EXPECT_NEAR(coarse / fine, 4, 0.3) << "times: half the step, a quarter of the error (of the orientation)";
  EXPECT_NEAR(fine / finer, 4, 0.2) << "times: half the step, a quarter of the error (of the orientation)";
}

TEST(Ex05Tumble, GoesBack) {
  Tumbler body = tumbler({0.8, 2, 0.5});
  const Tumbler start = body;
  for (int k = 0; k < 100; ++k) step(body, 0.1);
  for (int k = 0; k < 100; ++k) step(body, -0.1);
  EXPECT_LE((body.momentum - start.momentum).norm(), 1e-11 * start.momentum.norm())
      << "kg m^2/s: a hundred steps forwards and a hundred back; the rule is the same in both directions of time";
  EXPECT_LE((body.rotation - start.rotation).norm(), 1e-11)
      << "of the rotation matrix: the body is where it was";
}

TEST(Ex05Tumble, APrincipalAxisStays) {
  Tumbler body = tumbler({0, 0, 3});
  for (int k = 0; k < 100; ++k) step(body, 0.1);
  EXPECT_LE((body.momentum - Vec3(0, 0, 39)).norm(), 1e-11)
      << "kg m^2/s: about a principal axis the body spins on for ever, 13 kg m^2 times 3 rad/s";
  // The rule's turn in a step is 2 atan(h w / 2), a little less than h w.
  const double angle = 100 * 2 * std::atan(0.15);
  EXPECT_NEAR(body.rotation(0, 0), std::cos(angle), 1e-11) << "turned by 3 rad/s about z";
  EXPECT_NEAR(body.rotation(1, 0), std::sin(angle), 1e-11) << "turned by 3 rad/s about z, from x to y";
}

TEST(Ex05Tumble, CountsItsWork) {
  Tumbler body = tumbler({0.8, 2, 0.5});
  const int rounds = step(body, 0.05);
  EXPECT_GE(rounds, 3) << "an implicit equation is not solved in one go";
  EXPECT_LE(rounds, 40)
      << "evaluations: each leaves a third of the error, so forty are more than a double has digits";
}

// Boxes down to a tenth as thin as long, at the largest step that the contract allows.
TEST(Ex05Tumble, SolvesToRoundingAndThenStops) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(0.1, 1);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 squares = Vec3(any(random), any(random), any(random)).cwiseAbs2();
    const Vec3 spin = Vec3(gauss(random), gauss(random), gauss(random)).normalized();
    Tumbler body;
    body.moments = Vec3::Constant(squares.sum()) - squares;
    body.momentum = body.moments.cwiseProduct(spin);
    const Tumbler before = body;
    const double h = trial % 2 == 0 ? 0.5 : -0.5, size = before.momentum.norm();
    const int rounds = step(body, h);
    const Vec3 middle = 0.5 * (before.momentum + body.momentum);
    const Vec3 fault = body.momentum - before.momentum - h * middle.cross(middle.cwiseQuotient(body.moments));
    ASSERT_LE(fault.norm(), 1e-14 * size)
        << "kg m^2/s: so far L1 is from solving its equation, for moments of " << body.moments.transpose()
        << " kg m^2 and 0.5 rad in a step";
    ASSERT_NEAR(energy(body), energy(before), 1e-14 * energy(before))
        << "J: one step keeps the energy to rounding";
    ASSERT_LE(rounds, 40)
        << "evaluations: what still changes is the last bit, which may go to and fro for ever";
  }
}

}  // namespace

// Exercise 2.1. The truth is the given gap, which can be asked at as many times as one likes.
#include "ex01_capsule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using fc::Vec3;
using fc::exercises::Capsule;
using fc::exercises::closing_speed;
using fc::exercises::gap;
using fc::exercises::safe_step;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Any {
  std::mt19937_64 random{11};
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 vector(double size) { return size * Vec3(number(-1, 1), number(-1, 1), number(-1, 1)); }
  Capsule capsule() { return {vector(3), vector(2), vector(6), vector(1), vector(1), number(0, 1)}; }
};

// A body at rest far along x.
Capsule wall() {
  Capsule still;
  still.middle = {10, 0, 0};
  return still;
}
// Where an end is after h seconds, from its body's centre of mass.
Vec3 turned(const Capsule& c, const Vec3& x, double h) {
  const double rate = c.spin.norm();
  return rate > 0 ? Vec3(Eigen::AngleAxisd(rate * h, c.spin / rate) * x) : x;
}
// The most m/s of any end along d in a few turns.
double fastest_end(const Capsule& c, const Vec3& d) {
  double speed = -kInfinity;
  for (const Vec3& x : {c.p, c.q})
    for (int k = 0; k <= 3000; ++k)
      speed = std::max(speed, d.dot(c.velocity + c.spin.cross(turned(c, x, 0.01 * k))));
  return speed;
}
// The root of  c h + k h^2 = room  after now, plainly.
double parabola(double c, double k, double room) {
  return k > 0 ? (-c + std::sqrt(c * c + 4 * k * room)) / (2 * k) : c > 0 ? room / c : kInfinity;
}
int advances(const Capsule& a, const Capsule& b, double tolerance) {
  double t = 0;
  int n = 0;
  for (; n < 1000 && gap(a, b, Vec3::UnitX(), t) > tolerance; ++n) {
    Capsule at = a;
    at.middle += t * a.velocity;
    at.p = turned(a, a.p, t);
    at.q = turned(a, a.q, t);
    t += safe_step(at, b, Vec3::UnitX(), gap(a, b, Vec3::UnitX(), t) - tolerance / 2);
  }
  return n;
}

TEST(Ex01Capsule, NoEndIsFaster) {
  Any any;
  for (int trial = 0; trial < 100; ++trial) {
    const Capsule a = any.capsule(), b = any.capsule();
    const Vec3 n = any.vector(1).normalized();
    const double bound = closing_speed(a, b, n), truth = fastest_end(a, n) + fastest_end(b, -n);
    ASSERT_GE(bound, truth - 1e-12 * (1 + std::abs(truth)))
        << "the bound is " << bound << " m/s, but ends of the two close in with up to " << truth
        << " m/s: an advance that trusts it can step through a contact";
    ASSERT_LE(bound, truth + 0.01 * (fastest_end(a, n) - n.dot(a.velocity) + fastest_end(b, -n) +
                                     n.dot(b.velocity) + 1))
        << "the bound is " << bound << " m/s, but in 30 s no two ends close in with more than " << truth
        << " m/s: too large a bound is safe, but costs advances";
  }
}

TEST(Ex01Capsule, IsTheSameHoweverTheBodyIsTurned) {
  Any any;
  Capsule a = any.capsule();
  const Vec3 n = any.vector(1).normalized();
  const double now = closing_speed(a, wall(), n);
  a.p = turned(a, a.p, 0.4);
  a.q = turned(a, a.q, 0.4);
  const double later = closing_speed(a, wall(), n);
  EXPECT_NEAR(now, later, 1e-12) << "m/s now and 0.4 s later: a bound for all time cannot depend on the pose";
}

TEST(Ex01Capsule, IsZeroAlongTheSpin) {
  const Capsule top{{0, 0, 0}, {0, 0, 0}, {0, 0, 9}, {1, 2, 3}, {-1, 0, 0}, 0.5};
  const double bound = closing_speed(top, wall(), Vec3::UnitZ());
  EXPECT_NEAR(bound, 0, 1e-12) << "got " << bound << " m/s, but a top does not move along its spin";
}

TEST(Ex01Capsule, OnlyTheWayAcrossTheSpinCounts) {
  const Capsule rod{{0, 0, 0}, {0, 0, 0}, {0, 0, 2}, {0, 0, -5}, {0.5, 0, 5}, 0};
  const double bound = closing_speed(rod, wall(), Vec3::UnitX());
  EXPECT_NEAR(bound, 1, 1e-12) << "expected 2 rad/s times 0.5 m = 1 m/s, got " << bound
                               << " m/s: how far an end lies along the spin's line does not matter";
}

TEST(Ex01Capsule, TheRadiusCostsNothing) {
  const Capsule ball{{0, 0, 0}, {1, 0, 0}, {0, 50, 50}, {0, 0, 0}, {0, 0, 0}, 2};
  const double bound = closing_speed(ball, wall(), Vec3::UnitX());
  EXPECT_NEAR(bound, 1, 1e-12)
      << "a ball that flies with 1 m/s closes in with 1 m/s, however fast it spins; got " << bound << " m/s";
  const double step = safe_step(ball, wall(), Vec3::UnitX(), 3);
  EXPECT_NEAR(step, 3, 1e-12) << "s: 3 m at 1 m/s; that it spins takes nothing off";
}

TEST(Ex01Capsule, SeesTheOtherBodyFromItsSide) {
  Capsule b = wall();
  b.velocity = {-2, 0, 0};
  const double towards = closing_speed({}, b, Vec3::UnitX());
  EXPECT_NEAR(towards, 2, 1e-12) << "B flies at A with 2 m/s, got " << towards
                                 << " m/s: what B does along n counts the other way round";
  b.velocity = {2, 0, 0};
  const double away = closing_speed({}, b, Vec3::UnitX());
  EXPECT_NEAR(away, -2, 1e-12) << "B flies away with 2 m/s, got " << away << " m/s";
}

TEST(Ex01Capsule, WhoFleesFasterIsNeverCaught) {
  const Capsule a{{0, 0, 0}, {3, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, -1, 0}, 0.2};
  Capsule b = wall();
  b.velocity = {5, 0, 0};
  const double bound = closing_speed(a, b, Vec3::UnitX());
  EXPECT_NEAR(bound, -1, 1e-12) << "A: 3 m/s and 1 m/s from turning; B flees with 5 m/s; got " << bound
                                << " m/s: only the sum of both bodies may be compared with zero";
  const double step = safe_step(a, b, Vec3::UnitX(), 1e-9);
  EXPECT_TRUE(std::isinf(step)) << "s: got " << step << ", but the two part for ever";
}

TEST(Ex01Capsule, AStepIsNeverTooLong) {
  Any any;
  for (int trial = 0; trial < 2000; ++trial) {
    const Capsule a = any.capsule(), b = any.capsule();
    const Vec3 n = any.vector(1).normalized();
    const double room = std::pow(10, any.number(-6, 0.5)), step = safe_step(a, b, n, room);
    ASSERT_GE(step, 0) << "s: a step leads forwards";
    const double until = std::min(step, 5.0), now = gap(a, b, n, 0);
    for (int k = 1; k <= 200; ++k) {
      const double lost = now - gap(a, b, n, until * k / 200);
      ASSERT_LE(lost, room * (1 + 1e-9) + 1e-13)
          << "the step is " << step << " s, but after " << until * k / 200 << " s the gap has shrunk by "
          << lost << " m and not by at most " << room << " m: here a contact would be missed";
    }
  }
}

TEST(Ex01Capsule, AStepIsAsLongAsTheSpeedAllows) {
  Any any;
  for (int trial = 0; trial < 500; ++trial) {
    const Capsule a = any.capsule(), b = any.capsule();
    const Vec3 n = any.vector(1).normalized();
    const double speed = closing_speed(a, b, n), room = any.number(0.1, 9);
    if (speed <= 0) continue;
    ASSERT_GE(safe_step(a, b, n, room), room / speed * (1 - 1e-12))
        << "s: " << room << " m at " << speed << " m/s; the longer one of two safe steps is safe";
  }
}

TEST(Ex01Capsule, AStepKnowsTheSpeedOfNow) {
  const Capsule a{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}, 0.3};
  const double step = safe_step(a, wall(), Vec3::UnitX(), 0.4), want = 1 + std::sqrt(1.8);
  EXPECT_GE(step, want * (1 - 1e-12))
      << "s: A's end recedes with 1 m/s, and 1 m/s^2 brings it back to use up 0.4 m "
      << "no sooner than after 1 + sqrt(1.8) s; got " << step << " s";
}

TEST(Ex01Capsule, EachEndHasItsOwnRoom) {
  // q lies 1 m behind p, and is the one that moves.
  const Capsule a{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {-1, -1, 0}, 0.3};
  const double want = parabola(1, std::sqrt(0.5), 1.1), step = safe_step(a, wall(), Vec3::UnitX(), 0.1);
  EXPECT_GE(step, want * (1 - 1e-12))
      << "s: the end in front stands still; the one that moves with 1 m/s has 1.1 m "
      << "to go, not 0.1 m; got " << step << " s";
}

TEST(Ex01Capsule, DoublesTheDigits) {
  const Capsule a{{0, 0, 0}, {0.5, 0, 0}, {0.3, 0.2, 2}, {1, 2, 0.5}, {-1, -2, 0}, 0.5};
  const int few = advances(a, wall(), 1e-3), many = advances(a, wall(), 1e-12);
  EXPECT_LE(many, 40) << "advances until the gap is 1e-12 m";
  EXPECT_LE(many, few + 4)
      << "advances: nine more digits are three or four more, for the speed of now is exact";
}

// In long double: the largest speeds are known, and of what does not spin the step.
TEST(Ex01Capsule, BoundsHoldToTheLastDigit) {
  using Long = long double;
  using Long3 = Eigen::Matrix<Long, 3, 1>;
  Any any;
  for (int trial = 0; trial < 2000; ++trial) {
    Capsule a = any.capsule(), b = any.capsule();
    const Vec3 n = trial % 3 == 0 ? Vec3((a.spin + 1e-6 * any.vector(1)).normalized())
                                  : Vec3(any.vector(1).normalized());
    const Long3 long_n = n.cast<Long>();
    const auto turning = [&](const Capsule& c) {
      const Long3 spin = c.spin.cast<Long>();
      const Long reach =
          std::max(c.p.cast<Long>().cross(spin).norm(), c.q.cast<Long>().cross(spin).norm()) / spin.norm();
      return long_n.cross(spin).norm() * reach;
    };
    const Long3 velocity = a.velocity.cast<Long>() - b.velocity.cast<Long>();
    const Long excess = closing_speed(a, b, n) - (long_n.dot(velocity) + turning(a) + turning(b));
    ASSERT_GE(excess, 0)
        << "m/s: so much the bound is too small, by rounding; then \"they part for ever\" may be a lie";
    ASSERT_LE(excess, 1e-12L * (velocity.norm() + 2 * (a.spin.norm() + b.spin.norm())))
        << "m/s: so much the bound is too large; rounding does not ask for that";

    a.spin = b.spin = Vec3::Zero();
    const double room = std::pow(10, any.number(-9, 1)), step = safe_step(a, b, n, room);
    if (std::isinf(step)) continue;
    ASSERT_LE(long_n.dot(velocity) * step, Long(room))
        << "m: after a step of " << step << " s the gap has shrunk by this, more than by " << room
        << " m, if only by rounding";
  }
}

TEST(Ex01Capsule, ItDoesNotMatterWhereTheOriginIs) {
  Any any;
  for (int trial = 0; trial < 200; ++trial) {
    Capsule a = any.capsule(), b = any.capsule();
    const Vec3 n = any.vector(1).normalized(), shift = any.vector(1e8);
    const double room = std::pow(10, any.number(-9, -3)), here = safe_step(a, b, n, room);
    a.middle += shift;
    b.middle += shift;
    const double there = safe_step(a, b, n, room);
    if (std::isinf(here)) continue;
    ASSERT_NEAR(there / here, 1, 1e-12)
        << "of the step of " << here << " s, for bodies that are " << shift.norm()
        << " m from the origin: differences of such places have 8 digits left";
  }
}

}  // namespace

// Exercise 1.5. The gap is a formula, so every step can be looked at from end to end.
#include "ex05_crank.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace {

using fc::exercises::Crank;
using fc::exercises::gap;
using fc::exercises::safe_step;

struct Any {
  std::mt19937_64 random{5};
  std::uniform_real_distribution<double> u{-1, 1};

  Crank crank() {
    Crank c;
    c.arm = std::exp(2 * u(random));
    c.clearance = c.arm * (1 + 0.8 * u(random));
    c.angle = 4 * u(random);
    c.spin = 5 * u(random);
    return c;
  }
};

// The parabola's time in long double, by bisection.
double parabola(const Crank& q, double t, double target) {
  using Long = long double;
  const Long phase = Long(q.angle) + Long(q.spin) * t,
             room = Long(q.clearance) - q.arm * std::sin(phase) - target;
  const Long c = Long(q.arm) * q.spin * std::cos(phase), k = Long(q.arm) * q.spin * q.spin / 2;
  Long low = 0, high = 1;
  while (room - c * high - k * high * high > 0) high *= 2;
  for (int i = 0; i < 200; ++i) {
    const Long middle = (low + high) / 2;
    (room - c * middle - k * middle * middle > 0 ? low : high) = middle;
  }
  return static_cast<double>(low);
}

int advances(const Crank& crank, double tolerance, int most = 10'000) {
  double t = 0;
  int n = 0;
  for (; n < most && gap(crank, t) > tolerance && t < 1e6; ++n) t += safe_step(crank, t, tolerance / 2);
  return n;
}

TEST(Ex05Crank, NoStepGoesTooFar) {
  Any any;
  for (int i = 0; i < 2000; ++i) {
    const Crank q = any.crank();
    const double t = any.u(any.random), now = gap(q, t);
    if (now <= 0) continue;
    const double target = now * (0.5 + 0.49 * any.u(any.random));
    const double step = safe_step(q, t, target);
    const double look = std::isfinite(step) ? step : 20;
    for (int k = 0; k <= 400; ++k)
      ASSERT_GE(gap(q, t + look * k / 400), target - 1e-13 * (1 + q.clearance + q.arm))
          << "m: " << look * k / 400 << " s into a step of " << step << " s the pin is higher than allowed";
  }
}

TEST(Ex05Crank, AsLongAsTheSpeedAllows) {
  Any any;
  for (int i = 0; i < 2000; ++i) {
    const Crank q = any.crank();
    const double now = gap(q, 0);
    if (now <= 0) continue;
    EXPECT_GE(safe_step(q, 0, now / 2), (now / 2) / (q.arm * std::abs(q.spin)) * (1 - 1e-12))
        << "s: the linear step is safe too; the longer one of two safe steps is safe";
  }
}

TEST(Ex05Crank, AsLongAsTheParabolaAllows) {
  Any any;
  for (int i = 0; i < 500; ++i) {
    const Crank q = any.crank();
    const double now = gap(q, 0);
    if (now <= 0) continue;
    EXPECT_GE(safe_step(q, 0, now / 2), parabola(q, 0, now / 2) * (1 - 1e-12))
        << "s: gap - c h - k h^2 allows a longer step; is your c the closing speed of now, with its sign?";
  }
}

TEST(Ex05Crank, SeesThatThePinMovesAway) {
  const Crank q{1, 0.9, std::numbers::pi, 1};  // on its way down
  EXPECT_GE(safe_step(q, 0, 0.4), 1 + std::sqrt(2.0) - 1e-12)
      << "s: the pin moves away with 1 m/s, and can come back no sooner than 1 + sqrt(2) s later";
}

TEST(Ex05Crank, KeepsItsDigitsWhereTheRoomIsTiny) {
  const Crank q{1, std::sin(1.0), 1, 1};  // gap(0) = 0 exactly, closing at cos(1) m/s
  const long double c = std::cos(1.0L);
  for (const double room : {1e-6, 1e-9, 1e-12, 1e-15}) {
    const auto truth = static_cast<double>(2 * room / (c + std::sqrt(c * c + 2 * room)));
    EXPECT_NEAR(safe_step(q, 0, -room) / truth, 1, 1e-12)
        << "the step for a room of " << room << " m, as a part of what it should be";
  }
}

TEST(Ex05Crank, DoublesTheDigits) {
  const Crank q{1, 0.5, -1, 1};  // it meets the ceiling at 30 degrees, at cos(30 degrees) m/s
  EXPECT_LE(advances(q, 1e-12), 8) << "advances to 1e-12 m: the linear step needs 14";
  EXPECT_LE(advances(q, 1e-12), advances(q, 1e-3) + 3) << "nine more digits are two or three more advances";
}

TEST(Ex05Crank, GrazingIsNoTrouble) {
  // The pin touches the ceiling at the top of its circle, or misses it by a hair.
  EXPECT_LE(advances({1, 1, -1, 1}, 1e-10), 60)
      << "advances to a touch at the top, where the pin hardly closes in any more: the linear step needs ten thousand";
  EXPECT_LE(advances({1, 1 + 1e-3, -1, 1}, 1e-6), 1) << "it never comes so high: one look tells";
}

TEST(Ex05Crank, ForEverIsInfinity) {
  EXPECT_TRUE(std::isinf(safe_step({1, 2, 0.3, 0}, 0, 0.1)))
      << "s: it does not turn, so its gap stays as it is for ever";
  EXPECT_TRUE(std::isinf(safe_step({1, 2, 0.3, -7}, 0, 0.99)))
      << "s: 1 m is left even at the top of the circle, more than the target";
  EXPECT_TRUE(std::isfinite(safe_step({1, 2, 0.3, -7}, 0, 1.01)))
      << "s: but not 1.01 m: the pin will be nearer";
}

TEST(Ex05Crank, ASlowPinTurnsAllTheSame) {
  const Crank q{1, 0.9, 3, 1};  // on its way down
  for (const double slower : {1e-6, 1e-150, 1e-170, 1e-300}) {
    const Crank slow{q.arm, q.clearance, q.angle, q.spin * slower};
    EXPECT_NEAR(safe_step(slow, 0, 0.4) * slower / safe_step(q, 0, 0.4), 1, 1e-12)
        << "of the step it should be: a pin that turns " << slower
        << " times as fast takes as much longer, and not for "
        << "ever; the square of its spin may be 0";
  }
}

TEST(Ex05Crank, TurnsEitherWay) {
  const Crank q{1, 0.5, 1 - std::numbers::pi, -1};  // the mirror image of DoublesTheDigits
  EXPECT_EQ(advances(q, 1e-9), advances({1, 0.5, -std::numbers::pi - (1 - std::numbers::pi), 1}, 1e-9))
      << "advances of a pin that turns the other way, and of its mirror image";
  const Crank away{1, 0.9, 0, -1};
  EXPECT_GE(safe_step(away, 0, 0.4), 1 + std::sqrt(2.0) - 1e-12)
      << "s: with this spin it turns downwards, and comes back no sooner than 1 + sqrt(2) s later";
}

}  // namespace

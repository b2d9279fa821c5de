// Exercise 4.1. The oracle goes from bounce to bounce, in long double.
#include "ex01_zeno.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace {

using fc::exercises::ball_at;
using fc::exercises::BallState;
using fc::exercises::Drop;

struct Slow {
  long double height, velocity;
  long bounces;
};
// Not for restitution 0, nor after the bounces have piled up.
Slow slowly(const Drop& drop, double at) {
  long double h = drop.height, v = drop.velocity, t = at;
  const long double g = drop.gravity;
  for (long n = 0;; ++n) {
    const long double hit = std::sqrt(v * v + 2 * g * h), fall = (v + hit) / g;
    if (t < fall) return {h + t * (v - 0.5L * g * t), v - g * t, n};
    t -= fall;
    h = 0;
    v = drop.restitution * hit;
  }
}
double zeno_time(const Drop& d) {
  const double hit = std::sqrt(d.velocity * d.velocity + 2 * d.gravity * d.height);
  return (d.velocity + hit) / d.gravity + 2 * d.restitution * hit / (d.gravity * (1 - d.restitution));
}

void expect_as_slowly(const Drop& drop, double t) {
  const BallState ball = ball_at(drop, t);
  const Slow slow = slowly(drop, t);
  EXPECT_FALSE(ball.at_rest) << "at t = " << t << " s it still bounces";
  EXPECT_EQ(ball.bounces, slow.bounces) << "bounces until t = " << t << " s, one for each touch of the floor";
  EXPECT_NEAR(ball.height, static_cast<double>(slow.height), 1e-9)
      << "m, height at t = " << t << " s, as a ball has it that goes from bounce to bounce";
  EXPECT_NEAR(ball.velocity, static_cast<double>(slow.velocity), 1e-7)
      << "m/s, upwards, at t = " << t << " s, as a ball has it that goes from bounce to bounce";
}

TEST(Ex01Zeno, TheFirstFall) {
  const Drop drop{2, 0, 0.5, 10};
  EXPECT_NEAR(ball_at(drop, 0.3).height, 2 - 0.45, 1e-12) << "m: a free fall, h - g t^2 / 2";
  EXPECT_NEAR(ball_at(drop, 0.3).velocity, -3, 1e-12) << "m/s: a free fall, -g t";
  EXPECT_EQ(ball_at(drop, 0.3).bounces, 0) << "bounces: it comes to the floor only after 0.63 s";
}

TEST(Ex01Zeno, FromBounceToBounce) {
  for (const double e : {0.3, 0.5, 0.7, 0.9}) {
    const Drop drop{1.3, 0.4, e, 9.81};
    for (int i = 0; i < 400; ++i) expect_as_slowly(drop, (0.0003 + i / 401.0) * zeno_time(drop) * (1 - 1e-9));
  }
}

TEST(Ex01Zeno, ThrownUpAndDown) {
  for (const double v : {3.0, -3.0, -0.1})
    for (int i = 1; i < 100; ++i) {
      const Drop drop{0.7, v, 0.8, 9.81};
      expect_as_slowly(drop, i / 100.0 * zeno_time(drop) * (1 - 1e-9));
    }
}

TEST(Ex01Zeno, AfterInfinitelyManyBouncesItLies) {
  const Drop drop{2, 0, 0.7, 9.81};
  const double zeno = zeno_time(drop);
  for (const double t : {zeno * (1 + 1e-12), zeno + 0.1, zeno + 1e6}) {
    const BallState ball = ball_at(drop, t);
    EXPECT_TRUE(ball.at_rest) << "t = " << t << " s is after the last of all bounces, " << zeno << " s";
    EXPECT_EQ(ball.bounces, -1) << "bounces: there were infinitely many, which is reported as -1";
    EXPECT_EQ(ball.height, 0) << "m: it lies on the floor";
    EXPECT_EQ(ball.velocity, 0) << "m/s: it lies still";
  }
  const BallState before = ball_at(drop, zeno * (1 - 1e-6));
  EXPECT_FALSE(before.at_rest) << "a millionth before the end it still bounces";
  EXPECT_GT(before.bounces, 30)
      << "bounces: each leaves 0.7 of the time to the end, so a millionth is left after 39";
}

// The last doubles before the end and the first after it: there all arcs start at the same time, and a search
// for the right one may look for ever.
TEST(Ex01Zeno, AroundTheEndItself) {
  constexpr int kDoubles = 8;  // on each side of the end
  for (const double e : {1e-9, 0.3, 0.7, 0.99, 1 - 1e-6, 1 - 1e-9}) {
    for (int i = 0; i < 50; ++i) {
      const Drop drop{0.1 + 0.05 * i, 0.03 * i - 0.7, e, 1 + 0.2 * i};
      double t = zeno_time(drop);
      for (int k = 0; k < kDoubles; ++k) t = std::nextafter(t, 0);
      BallState last;
      for (int k = -kDoubles; k <= kDoubles; ++k, t = std::nextafter(t, 1e300)) {
        const BallState ball = ball_at(drop, t);
        ASSERT_TRUE(std::isfinite(ball.velocity)) << "m/s, at t = " << t << " s, restitution " << e;
        ASSERT_GE(ball.height, 0) << "m, at t = " << t << " s: below the floor";
        ASSERT_LE(ball.height, 1e-9) << "m, at t = " << t << " s: so near the end it hardly rises";
        ASSERT_TRUE(ball.at_rest || !last.at_rest) << "at t = " << t << " s it lay, and bounces again";
        if (!ball.at_rest) {
          ASSERT_GE(ball.bounces, last.bounces) << "at t = " << t << " s: bounces were taken back";
        }
        last = ball;
      }
    }
  }
}

TEST(Ex01Zeno, BouncesAreNeverTakenBack) {
  const Drop drop{1, 0.3, 0.95, 9.81};
  std::int64_t last = 0;
  constexpr int kTimes = 20'000;
  for (int i = 0; i < kTimes; ++i) {
    const double t = zeno_time(drop) * i / kTimes;
    const BallState ball = ball_at(drop, t);
    ASSERT_FALSE(ball.at_rest) << "at t = " << t << " s it still bounces";
    ASSERT_GE(ball.bounces, last) << "bounces until t = " << t << " s: there were more before";
    last = ball.bounces;
  }
  EXPECT_GT(last, 100) << "bounces: near the end there were many";
}

// Half a second down, then one second for each bounce, all in numbers that a double holds exactly.
TEST(Ex01Zeno, CountsMoreThanALoopCould) {
  const Drop drop{1, 0, 1, 8};
  for (const double arcs : {1e3, 1e9, 1e12, 1e15}) {
    const BallState ball = ball_at(drop, arcs + 0.75);
    EXPECT_EQ(ball.bounces, static_cast<std::int64_t>(arcs) + 1)
        << "bounces: one a second, the first after 1/2 s";
    EXPECT_NEAR(ball.height, 0.75, 1e-12)
        << "m, 1/4 s after bounce " << arcs + 1 << ", which it left at 4 m/s";
    EXPECT_NEAR(ball.velocity, 2, 1e-12) << "m/s, upwards, 1/4 s after a bounce at 4 m/s with g = 8 m/s^2";
  }
}

TEST(Ex01Zeno, WithoutLossItNeverRests) {
  const Drop drop{1, 0, 1, 9.81};
  for (const double t : {0.3, 1.0, 7.7, 100.0, 1e4}) expect_as_slowly(drop, t);
}

// 1 - e^k has no digits left where e is nearly 1; expm1 and log1p have them all.
TEST(Ex01Zeno, WithHardlyAnyLoss) {
  for (const double loss : {1e-3, 1e-6, 1e-9}) {
    const Drop drop{1, 0, 1 - loss, 9.81};
    for (const double t : {0.9, 12.3, 456.7, 5000.1, 1e5}) {
      if (t < zeno_time(drop)) expect_as_slowly(drop, t);
    }
  }
}

TEST(Ex01Zeno, WithoutRestitutionItStaysDown) {
  const Drop drop{5, 0, 0, 10};
  EXPECT_FALSE(ball_at(drop, 0.999).at_rest) << "it still falls: 5 m take 1 s";
  EXPECT_TRUE(ball_at(drop, 1.001).at_rest) << "it fell 5 m in 1 s, and does not bounce";
  EXPECT_TRUE(ball_at({0, 0, 0.5, 10}, 0).at_rest) << "it lies there from the start";
  EXPECT_EQ(ball_at({0, -2, 0.5, 10}, 0).bounces, 1) << "thrown down from the floor it bounces at once";
}

TEST(Ex01Zeno, EnergyFallsByTheSquareOfRestitution) {
  const Drop drop{2, 1, 0.6, 9.81};
  const double start = 0.5 + 9.81 * 2;  // J per kg
  for (int i = 1; i < 300; ++i) {
    const BallState ball = ball_at(drop, i / 300.0 * zeno_time(drop));
    ASSERT_FALSE(ball.at_rest) << "at t = " << i / 300.0 * zeno_time(drop) << " s it still bounces";
    const double energy = 0.5 * ball.velocity * ball.velocity + 9.81 * ball.height;
    EXPECT_NEAR(energy, start * std::pow(0.36, static_cast<double>(ball.bounces)), 1e-9)
        << "J per kg after " << ball.bounces << " bounces, of which each leaves 0.36";
  }
}

// v + sqrt(v^2 + 2 g h) has no digits left where a ball is thrown down hard from close by.
TEST(Ex01Zeno, ThrownDownHardFromClose) {
  for (const double speed : {1.0, 1e3, 1e6}) {
    for (const double height : {1e-3, 1e-9, 1e-12}) {
      const Drop drop{height, -speed, 0.5, 10};
      const long double hit = std::sqrt((long double)(speed)*speed + 20 * (long double)(height));
      const auto first = static_cast<double>(2 * (long double)(height) / (hit + speed));  // s
      EXPECT_EQ(ball_at(drop, first * (1 - 1e-11)).bounces, 0)
          << "bounces before " << first << " s, when the ball, thrown down at " << speed << " m/s from "
          << height << " m, comes to the floor";
      EXPECT_EQ(ball_at(drop, first * (1 + 1e-11)).bounces, 1)
          << "bounces after " << first << " s: it was at the floor";
    }
  }
}

TEST(Ex01Zeno, TimesAndBouncesBeyondAllCounting) {
  for (const double t : {1e17, 1e30, 1e300}) {
    const BallState ball = ball_at({1, 0, 1, 8}, t);
    EXPECT_GE(ball.bounces, 99'000'000'000'000'000) << "bounces, one a second, until t = " << t << " s";
    EXPECT_LE(ball.bounces, 1'000'000'000'000'000'128)
        << "bounces: more are not counted; an integer has an end";
    EXPECT_TRUE(ball.height >= 0 && ball.height <= 1 && std::abs(ball.velocity) <= 4)
        << ball.height << " m and " << ball.velocity
        << " m/s: without loss it is always between the floor and 1 m";
  }
  for (const double e : {5e-324, 1e-310, 1e-200}) {
    const BallState ball = ball_at({1, 0, e, 9.81}, std::sqrt(2 / 9.81));
    EXPECT_TRUE(std::isfinite(ball.velocity) && ball.height == 0)
        << ball.height << " m and " << ball.velocity << " m/s: with a restitution of " << e
        << " it hardly leaves the floor";
  }
}

}  // namespace

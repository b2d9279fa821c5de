// Exercise 5.2. Closed forms in numbers that a double holds; then a ball that goes from bounce to bounce, in
// long double.
#include "ex02_last_bounce.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace fc::exercises;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Ending slowly(const Drop& drop, double width, double dt) {
  const long double e = drop.restitution, g = drop.gravity, slow = static_cast<long double>(width) / dt;
  long double speed = std::sqrt(2 * g * drop.height), time = speed / g;
  std::int64_t bounces = 0;
  for (; speed > slow; ++bounces) {
    speed *= e;
    time += 2 * speed / g;
  }
  long double cut = 0;
  for (long double arc = e * speed; arc > 1e-25L * speed; arc *= e) cut += 2 * arc / g;
  return {bounces, static_cast<double>(time), static_cast<double>(cut),
          static_cast<double>(speed * speed / 2)};
}

// Falls for half a second and arrives with 4 m/s; then come 2, 1, 1/2, ... m/s, after 1/2, 1/4, ... s.
const Drop kHalves{1, 0.5, 8};

TEST(Ex02LastBounce, CountsWhatIsFasterThanTheEnvelope) {
  constexpr double kFrame = 1. / 64;
  EXPECT_EQ(ending(kHalves, 0.9 * kFrame, kFrame).bounces, 3)
      << "bounces: 4, 2 and 1 m/s are faster than 0.9 m/s";
  EXPECT_EQ(ending(kHalves, 1.1 * kFrame, kFrame).bounces, 2)
      << "bounces: 4 and 2 m/s are faster than 1.1 m/s";
  EXPECT_EQ(ending(kHalves, 3.9 * kFrame, kFrame).bounces, 1)
      << "bounces: it arrives with 4 m/s, faster than 3.9, and then comes with 2";
  EXPECT_EQ(ending(kHalves, 4.1 * kFrame, kFrame).bounces, 0) << "bounces: already its first touch is slow";
  EXPECT_EQ(ending(kHalves, 1e3 * kFrame, kFrame).bounces, 0)
      << "bounces: 1000 m/s would be needed to be faster than this envelope";
}

TEST(Ex02LastBounce, JustAsFastDoesNotBounce) {
  constexpr double kFrame = 1. / 64;
  for (int k = 0; k <= 60; ++k) {
    const double slow = std::ldexp(4, -k);  // m/s
    EXPECT_EQ(ending(kHalves, slow * kFrame, kFrame).bounces, k)
        << "bounces: touch " << k << " comes with just h/dt, which is not faster";
    EXPECT_EQ(ending(kHalves, 0.999 * slow * kFrame, kFrame).bounces, k + 1)
        << "bounces: touch " << k << " is faster than h/dt, and the next one is not";
  }
}

TEST(Ex02LastBounce, WhenItLies) {
  constexpr double kFrame = 1. / 64;
  const Ending two = ending(kHalves, kFrame, kFrame);
  EXPECT_EQ(two.bounces, 2) << "bounces: with 4 and 2 m/s; 1 m/s is just h/dt";
  EXPECT_NEAR(two.time, 0.5 + 0.5 + 0.25, 1e-15) << "s: the fall, and two arcs; it lies from touch 2 on";
  EXPECT_NEAR(two.cut, 0.125 + 0.125, 1e-15) << "s: 1/8 + 1/16 + ... were to come";
  EXPECT_NEAR(two.energy, 0.5, 1e-15) << "J/kg: touch 2 comes with 1 m/s";
  const Ending none = ending(kHalves, 4 * kFrame, kFrame);
  EXPECT_NEAR(none.time, 0.5, 1e-15) << "s: the envelope takes it after the fall, before any arc";
  EXPECT_NEAR(none.cut, 1, 1e-15) << "s: arcs of 1/2, 1/4, ... s were to come";
  EXPECT_NEAR(none.energy, 8, 1e-14) << "J/kg: the first touch loses all that it had, at 4 m/s";
}

TEST(Ex02LastBounce, WithoutRestitution) {
  const Ending fast = ending({5, 0, 10}, 1e-3, 0.01);  // 10 m/s after 1 s
  EXPECT_EQ(fast.bounces, 1) << "the first touch is an event; there is no second one";
  EXPECT_NEAR(fast.time, 1, 1e-15) << "s: touch 1 comes at the time of touch 0";
  EXPECT_EQ(fast.cut, 0) << "s: without restitution no bounce was to come";
  EXPECT_EQ(fast.energy, 0) << "J/kg: the first touch, an event, took it all";
  EXPECT_EQ(ending({5, 0, 10}, 1, 0.01).bounces, 0) << "the envelope takes it at once";
}

TEST(Ex02LastBounce, WithoutLoss) {
  const Ending ever = ending({5, 1, 10}, 1e-3, 0.01);
  EXPECT_EQ(ever.bounces, -1)
      << "bounces: without loss it never becomes slow; infinitely many are reported as -1";
  EXPECT_EQ(ever.time, kInfinity) << "s: no touch is ever slow enough for the envelope";
  const Ending taken = ending({5, 1, 10}, 0.2, 0.01);
  EXPECT_EQ(taken.bounces, 0) << "bounces: 20 m/s are needed, it has 10";
  EXPECT_NEAR(taken.time, 1, 1e-15) << "s: 5 m of fall at 10 m/s^2";
  EXPECT_EQ(taken.cut, kInfinity) << "s: it would have bounced for ever";
  EXPECT_NEAR(taken.energy, 50, 1e-12) << "J/kg: 10 m/s, all lost at once";
}

TEST(Ex02LastBounce, AsFromBounceToBounce) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(0, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Drop drop{0.01 + 5 * any(random), 0.02 + 0.96 * any(random), 1 + 20 * any(random)};
    const double width = std::pow(10, -5 + 3 * any(random)), dt = 0.001 + 0.03 * any(random);
    const Ending got = ending(drop, width, dt), slow = slowly(drop, width, dt);
    ASSERT_EQ(got.bounces, slow.bounces)
        << "bounces, as a ball has them that goes from one to the next (restitution " << drop.restitution
        << ", trial " << trial << ")";
    ASSERT_NEAR(got.time, slow.time, 1e-12 * slow.time)
        << "s until it lies, as a ball has it that goes from bounce to bounce (trial " << trial << ")";
    ASSERT_NEAR(got.cut, slow.cut, 1e-12 * slow.cut)
        << "s of bouncing cut off, as a ball has it that goes on (trial " << trial << ")";
    ASSERT_NEAR(got.energy, slow.energy, 1e-12 * slow.energy)
        << "J/kg lost at the last touch, as a ball has it that goes from bounce to bounce (trial " << trial
        << ")";
  }
}

// 1 - e^k has no digits left where e is nearly 1; expm1 has them all. To first order in the loss d, the speed
// after k bounces is u (1 - k d).
TEST(Ex02LastBounce, WithHardlyAnyLoss) {
  for (const double loss : {1e-6, 1e-9}) {
    const Drop drop{5, 1 - loss, 10};
    const double width = 10 * (1 - 1.5 * loss) * 0.01;  // between the speeds of the touches 1 and 2
    const Ending got = ending(drop, width, 0.01);
    EXPECT_EQ(got.bounces, 2) << "bounces: the envelope lies between the speeds of the touches 1 and 2 (loss "
                              << loss << ")";
    EXPECT_NEAR(got.time, 5 - 6 * loss + 2 * loss * loss, 1e-12)
        << "s: two arcs of hardly less than 2 s; loss " << loss;
    EXPECT_NEAR(got.cut * (1 - drop.restitution), 2, 1e-5) << "s: for 2 s / loss it would have gone on";
  }
}

TEST(Ex02LastBounce, TheWidestEnvelopeCutsOneFrame) {
  for (const double e : {0.1, 0.5, 0.9, 0.999}) {
    for (const double dt : {1. / 240, 1. / 60}) {
      const double width = widest_envelope(e, 9.81, dt), slow = width / dt;
      const auto cut = [&](double speed) { return ending({speed * speed / 19.62, e, 9.81}, width, dt).cut; };
      EXPECT_NEAR(cut(slow * (1 - 1e-9)), dt, 1e-8 * dt)
          << "s: who comes with just h/dt loses just a frame; restitution " << e;
      for (const double part : {0.3, 0.9, 1.1, 5.0, 77.0})
        EXPECT_LE(cut(part * slow), dt * (1 + 1e-9)) << "s: nobody loses more; restitution " << e;
    }
  }
  EXPECT_EQ(widest_envelope(0, 9.81, 0.01), kInfinity) << "m: without a bounce nothing is cut";
  EXPECT_EQ(widest_envelope(1, 9.81, 0.01), 0) << "m: without loss there is no last bounce";
}

TEST(Ex02LastBounce, TheNarrowestForSoManyBounces) {
  constexpr double kFrame = 1. / 64;
  EXPECT_EQ(narrowest_envelope(kHalves, kFrame, 0), 4 * kFrame)
      << "m: not even the first touch may be faster";
  EXPECT_EQ(narrowest_envelope(kHalves, kFrame, 3), 0.5 * kFrame) << "m: touch 3 comes with 1/2 m/s";
  for (const double e : {0.3, 0.7, 0.95}) {
    const Drop drop{2, e, 9.81};
    for (const std::int64_t bounces : {0, 1, 5, 20}) {
      const double width = narrowest_envelope(drop, kFrame, bounces);
      EXPECT_LE(ending(drop, width * (1 + 1e-9), kFrame).bounces, bounces)
          << "bounces: this width leaves at most so many";
      EXPECT_GT(ending(drop, width * (1 - 1e-9), kFrame).bounces, bounces)
          << "bounces: no narrower envelope leaves so few";
    }
  }
}

TEST(Ex02LastBounce, TheShortestFrame) {
  EXPECT_NEAR(shortest_frame(0.5, 8, 1e-4), 0.005, 1e-17) << "s: sqrt(2 h / g) for a restitution of 1/2";
  for (const double e : {0.1, 0.6, 0.99}) {
    const double dt = shortest_frame(e, 9.81, 1e-4);
    EXPECT_NEAR(widest_envelope(e, 9.81, dt), 1e-4, 1e-16) << "m: then it is just as wide as it has to be";
  }
  EXPECT_EQ(shortest_frame(0, 9.81, 1e-4), 0) << "s: without a bounce any frame will do";
  EXPECT_EQ(shortest_frame(1, 9.81, 1e-4), kInfinity) << "s: without loss no frame is long enough";
}

}  // namespace

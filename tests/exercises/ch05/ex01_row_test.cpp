// Exercise 5.1. Closed forms first; then random balls, for what holds in every frame.
#include "ex01_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace fc::exercises;

constexpr double kWidth = 1. / 1024, kFrame = 1. / 64;  // m, s: exact numbers
constexpr double kGravity = 9.81;                       // m/s^2; what falls so in a frame is 2.4 mm
const Envelope kEnvelope{kWidth, kFrame};
constexpr double kRounding = 1e-17;  // m; a thousandth of a millionth of a millionth of the envelope

double energy(const Ball& ball, double gravity) {  // J
  return ball.mass * (0.5 * ball.velocity * ball.velocity + gravity * ball.gap);
}

// First what matters most: an error of places must not become energy.
TEST(Ex01Row, NoFrameMakesEnergy) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(0, 1);
  int pushed = 0, displaced = 0, stopped = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const Envelope envelope{1e-4 + 0.01 * any(random), 0.001 + 0.03 * any(random), 0.1 + 0.9 * any(random),
                            0.5 * any(random)};
    const double gravity = trial % 3 == 0 ? 0 : 20 * any(random);
    Ball ball{0.1 + any(random), envelope.width * any(random), 0, any(random)};
    ball.velocity = (3 * any(random) - 1) * envelope.width / envelope.dt;
    const Ball before = ball;
    const Frame frame = rest(envelope, gravity, ball);
    ASSERT_LE(energy(ball, gravity), energy(before, gravity) + frame.energy + 1e-13)
        << "J, trial " << trial << ", with a gap of " << before.gap / envelope.width
        << " h at the start: more than the displacement added. A gap that is put right by a velocity makes energy out of an "
        << "error, and the ball keeps it; a displacement moves the ball, and no velocity hears of it";
    ASSERT_GE(frame.push, 0) << "N s: floors do not pull";
    ASSERT_GE(frame.stop, 0) << "N s: floors do not pull";
    ASSERT_GE(frame.displaced, 0) << "m: displacements widen gaps, never close them";
    ASSERT_GE(ball.gap, std::min(before.gap, 0.5 * envelope.width) - 1e-15)
        << "m, trial " << trial << ": it came nearer than the rest gap";
    ASSERT_NEAR(frame.energy, ball.mass * gravity * frame.displaced, 1e-15)
        << "J: what the displacement lifted, m g times its height";
    ASSERT_NEAR(ball.mass * (ball.velocity - before.velocity),
                frame.push + frame.stop - ball.mass * gravity * envelope.dt, 1e-13)
        << "N s, trial " << trial
        << ": the floor's impulses and the weight make the change of momentum (Newton)";
    if (frame.push > 1e-12) {
      ++pushed;
      ASSERT_NEAR(ball.gap - frame.displaced, std::min(before.gap, 0.5 * envelope.width), 1e-15)
          << "m: who is pushed ends at the bound (complementarity)";
    }
    displaced += frame.displaced > 0;
    stopped += frame.stop > 0;
  }
  EXPECT_GT(pushed, 1000) << "balls that were pushed, of the test itself";
  EXPECT_GT(displaced, 1000) << "balls that were displaced, of the test itself";
  EXPECT_GT(stopped, 1000) << "balls that were stopped, of the test itself";
}

TEST(Ex01Row, MayCloseInToTheRestGap) {
  EXPECT_EQ(approach_limit(kEnvelope, kWidth), 0.5 * kWidth / kFrame)
      << "m/s: half the envelope in one frame";
  EXPECT_EQ(approach_limit(kEnvelope, 0.75 * kWidth), 0.25 * kWidth / kFrame)
      << "m/s: a quarter of the envelope in one frame, to h/2";
  EXPECT_EQ(approach_limit(kEnvelope, 3 * kWidth), 2.5 * kWidth / kFrame)
      << "m/s: from outside of the envelope, too, it comes to h/2 by the plan's end";
  EXPECT_EQ(approach_limit(kEnvelope, 0.5 * kWidth), 0)
      << "m/s: it is at the rest gap, and may not come nearer";
}

TEST(Ex01Row, NoGapBecomesAVelocity) {
  for (const double part : {0.0, 0.1, 0.25, 0.499})
    EXPECT_EQ(approach_limit(kEnvelope, part * kWidth), 0)
        << "m/s, with a gap of " << part
        << " h: it may not come nearer, but nothing drives it out; that would make energy out of an error";
}

TEST(Ex01Row, WhatIsAnImpact) {
  const double fast = kWidth / kFrame, faster = std::nextafter(fast, 1);
  EXPECT_FALSE(is_impact(kEnvelope, {1, 0.25 * kWidth, -fast, 0.5}, false)) << "h/dt itself is not too fast";
  for (const double part : {0.0, 0.25, 0.5})
    EXPECT_TRUE(is_impact(kEnvelope, {1, part * kWidth, -faster, 0.5}, false))
        << "faster than h/dt, with a gap of " << part << " h";
  EXPECT_TRUE(is_impact(kEnvelope, {1, 0.25 * kWidth, -faster, 0}, false))
      << "an impact without bounce is an impact";
  EXPECT_FALSE(is_impact(kEnvelope, {1, 0.51 * kWidth, -10 * fast, 0.5}, false))
      << "farther away than the rest gap: it is not there yet, however fast";
  EXPECT_FALSE(is_impact(kEnvelope, {1, 0.25 * kWidth, -10 * fast, 0.5}, true))
      << "a contact that lasts closes in with the second half of gravity: that is no blow";
  EXPECT_FALSE(is_impact(kEnvelope, {1, 0.1 * kWidth, 10 * fast, 0.5}, false))
      << "it parts: there is nothing to hit";
}

TEST(Ex01Row, FallsInAndLies) {
  Ball ball{2, kWidth, 0, 0.5};
  const double weight = 2 * kGravity * kFrame;  // N s, in a frame
  Frame frame = rest(kEnvelope, kGravity, ball);
  EXPECT_NEAR(ball.gap, 0.5 * kWidth, kRounding) << "m: in one frame to the rest gap";
  EXPECT_EQ(ball.velocity, 0) << "m/s: the instant has stopped it; a plan pushed here, so it does not bounce";
  EXPECT_NEAR(frame.push, 0.5 * weight - 2 * 0.5 * kWidth / kFrame, 1e-14)
      << "N s: m (w - u), half of the weight but for what it still sinks";
  EXPECT_NEAR(frame.push + frame.stop, weight, 1e-14)
      << "N s: it lay still before and does so now: the weight, in all";
  for (int k = 0; k < 1000; ++k) {
    frame = rest(kEnvelope, kGravity, ball);
    ASSERT_EQ(ball.velocity, 0) << "m/s, frame " << k << ": it lies still";
    ASSERT_NEAR(ball.gap, 0.5 * kWidth, kRounding) << "m, frame " << k << ": it lies at the rest gap";
    ASSERT_NEAR(frame.push, 0.5 * weight, 1e-14) << "N s: half of the weight in the plan";
    ASSERT_NEAR(frame.stop, 0.5 * weight, 1e-14) << "N s: and half of it at its end";
  }
}

TEST(Ex01Row, WhatComesSlowlyIsStoppedAtTheEnd) {
  Ball ball{1, kWidth, -0.1 * kWidth / kFrame, 0.5};
  const Frame frame = rest(kEnvelope, 0, ball);
  EXPECT_EQ(frame.push, 0) << "N s: it does not come to the rest gap in this frame, nobody has to push";
  EXPECT_NEAR(ball.gap, 0.9 * kWidth, kRounding) << "m: it flies on, a tenth of the envelope in a frame";
  EXPECT_EQ(ball.velocity, 0)
      << "m/s: in contact nothing closes in after an instant, and what is slow does not bounce";
  EXPECT_NEAR(frame.stop, 0.1 * kWidth / kFrame, 1e-15) << "N s";
}

TEST(Ex01Row, WhatIsFastBounces) {
  // Thrown up so that it falls again within the frame, and comes back with nearly g dt / 2.
  Ball ball{1, 0.4 * kWidth, 0.5001 * kGravity * kFrame, 0.5};
  const Frame frame = rest(kEnvelope, kGravity, ball);
  EXPECT_EQ(frame.push, 0) << "N s: it moves upwards on average, nobody has to push";
  EXPECT_NEAR(ball.velocity, 0.5 * 0.4999 * kGravity * kFrame, 1e-15)
      << "m/s: half of the speed with which it came in";
}

TEST(Ex01Row, WhatIsNotThereYetIsLeftAlone) {
  Ball ball{1, 0.9 * kWidth, 0.5001 * kGravity * kFrame, 0.5};
  const Frame frame = rest(kEnvelope, kGravity, ball);
  EXPECT_EQ(frame.stop, 0) << "N s: faster than h/dt, but farther away than h/2";
  EXPECT_NEAR(ball.velocity, -0.4999 * kGravity * kFrame, 1e-15)
      << "m/s: it flies on, and gets its own instant";
}

TEST(Ex01Row, WhatPartsIsNotHeld) {
  for (const double part : {0.0, 0.3, 0.5, 0.9}) {
    Ball ball{1, part * kWidth, 1, 0};
    const Frame frame = rest(kEnvelope, kGravity, ball);
    EXPECT_EQ(frame.push + frame.stop, 0) << "N s: floors do not pull";
    EXPECT_NEAR(ball.velocity, 1 - kGravity * kFrame, 1e-15) << "m/s: only gravity acts on what parts";
    EXPECT_NEAR(ball.gap, part * kWidth + kFrame * (1 - 0.5 * kGravity * kFrame), 1e-15)
        << "m: the place of free flight, exactly: with the mean velocity, half of gravity; and nothing is to be put right";
    EXPECT_EQ(frame.displaced, 0) << "m: what counts is the gap at the plan's end";
  }
}

TEST(Ex01Row, HowFarAGapIsDisplaced) {
  for (const double part : {0.5, 0.6, 1.0, 5.0})
    EXPECT_EQ(displacement(kEnvelope, part * kWidth), 0)
        << "m, gap " << part << " h: from h/2 on nothing is to be put right";
  EXPECT_NEAR(displacement(kEnvelope, 0.3 * kWidth), 0.04 * kWidth, kRounding)
      << "m: a fifth of the 0.2 h that lack to h/2";
  EXPECT_NEAR(displacement(kEnvelope, 0.24 * kWidth), 0.052 * kWidth, kRounding)
      << "m: a fifth of 0.26 h is more than the hundredth that lacks to h/4";
  EXPECT_NEAR(displacement(kEnvelope, 0.1 * kWidth), 0.15 * kWidth, kRounding)
      << "m: what lacks to h/4, at once, for the least gap is there";
  EXPECT_NEAR(displacement({kWidth, kFrame, 1, 0}, 0), 0.5 * kWidth, kRounding)
      << "m: with a share of 1 all that lacks to h/2, at once";
}

TEST(Ex01Row, ATouchOpensToTheRestGap) {
  Ball ball{3, 0, 0, 0};
  double sum = 0;  // J
  for (int k = 1; k <= 60; ++k) {
    const Frame frame = rest(kEnvelope, kGravity, ball);
    sum += frame.energy;
    ASSERT_NEAR(ball.gap, kWidth * (0.5 - 0.25 * std::pow(0.8, k - 1)), kRounding)
        << "m, after frame " << k << ": at once to h/4, and then each frame leaves four fifths of what lacks";
    ASSERT_EQ(ball.velocity, 0) << "m/s, after frame " << k << ": displacements are no velocities";
    ASSERT_NEAR(sum, 3 * kGravity * ball.gap, 1e-15) << "J: all that the displacements have lifted, m g h";
  }
}

}  // namespace

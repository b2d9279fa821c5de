// Exercise 4.3. The oracle looks at all corners at many times.
#include "ex03_swept_box.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using fc::RigidBody;
using fc::Vec3;
using fc::exercises::swept_box;
using fc::world::Bounds;

constexpr double kRounding = 1e-12;  // m

struct Flight {
  Vec3 half;
  RigidBody start;
  Vec3 acceleration;
  double dt;
};

Flight random_flight(std::mt19937_64& random, double spin, double speed) {
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  Flight f;
  f.half = Vec3(0.7, 0.5, 0.3) + 0.2 * vector();
  f.start.position = vector();
  f.start.orientation = Eigen::AngleAxisd(3 * any(random), vector().normalized());
  f.start.velocity = speed * vector();
  f.start.spin = spin * vector();
  f.acceleration = speed > 0 ? Vec3(0, 0, -10) : Vec3(Vec3::Zero());
  f.dt = 0.5 + 0.4 * any(random);
  return f;
}

Bounds sampled(const Flight& f, int samples) {
  Bounds box{Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  const double rate = f.start.spin.norm();
  for (int k = 0; k <= samples; ++k) {
    const double t = f.dt * k / samples;
    const Vec3 centre = f.start.position + t * f.start.velocity + 0.5 * t * t * f.acceleration;
    fc::Quat turn = f.start.orientation;
    if (rate > 0) turn = fc::Quat(Eigen::AngleAxisd(rate * t, f.start.spin / rate)) * turn;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Vec3 x = centre + turn * f.half.cwiseProduct(signs);
      box.low = box.low.cwiseMin(x);
      box.high = box.high.cwiseMax(x);
    }
  }
  return box;
}

void expect_holds(const Flight& f) {
  const Bounds box = swept_box(f.half, f.start, f.acceleration, f.dt), inner = sampled(f, 2000);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LE(box.low[i], inner.low[i] + kRounding)
        << "m: a corner sticks out along axis " << i << " (low side)";
    EXPECT_GE(box.high[i], inner.high[i] - kRounding)
        << "m: a corner sticks out along axis " << i << " (high side)";
  }
}
void expect_tight(const Flight& f) {
  const Bounds box = swept_box(f.half, f.start, f.acceleration, f.dt), inner = sampled(f, 2000);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.low[i], inner.low[i], 1e-5) << "m: a smaller box would do along axis " << i;
    EXPECT_NEAR(box.high[i], inner.high[i], 1e-5) << "m: a smaller box would do along axis " << i;
  }
}

TEST(Ex03SweptBox, OfABlockThatStandsStill) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 50; ++k) {
    const Flight f = random_flight(random, 0, 0);
    expect_holds(f);
    expect_tight(f);
  }
}

// Up and down again: the top of the parabola lies inside the frame.
TEST(Ex03SweptBox, OfABlockThatFlies) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 100; ++k) {
    const Flight f = random_flight(random, 0, 3);
    expect_holds(f);
    expect_tight(f);
  }
}

TEST(Ex03SweptBox, OfABlockThatTurnsALittle) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 100; ++k) {
    const Flight f = random_flight(random, 2, 0);
    expect_holds(f);
    expect_tight(f);
  }
}

TEST(Ex03SweptBox, OfABlockThatTurnsRoundAndRound) {
  std::mt19937_64 random(4);
  for (int k = 0; k < 100; ++k) {
    const Flight f = random_flight(random, 40, 0);
    expect_holds(f);
  }
}

TEST(Ex03SweptBox, HoldsWhatFliesAndTurns) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 300; ++k) expect_holds(random_flight(random, k % 3 == 0 ? 1 : k % 3 == 1 ? 6 : 30, 3));
}

// The path alone is no longer than the smallest box, and neither is the turn: so their sum is at most twice
// as long. A ball around a thin block is not so modest.
TEST(Ex03SweptBox, IsAtMostTwiceTheSmallest) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 300; ++k) {
    Flight f = random_flight(random, k % 3 == 0 ? 0.5 : k % 3 == 1 ? 2 : 10, k % 2 == 0 ? 0.2 : 3);
    if (k % 5 == 0) f.half = Vec3(1, 0.05, 0.02);
    const Bounds box = swept_box(f.half, f.start, f.acceleration, f.dt), inner = sampled(f, 2000);
    for (int i = 0; i < 3; ++i) {
      const double side = box.high[i] - box.low[i], smallest = inner.high[i] - inner.low[i];
      ASSERT_LE(side, 2 * smallest + 1e-5)
          << "m: the box's side along axis " << i << ", where " << smallest << " m would do; flight " << k;
    }
  }
}

// Never larger than the ball around the block, carried along its path.
TEST(Ex03SweptBox, IsNoLargerThanTheBalls) {
  std::mt19937_64 random(6);
  for (int k = 0; k < 200; ++k) {
    Flight f = random_flight(random, 10, 3);
    const Bounds box = swept_box(f.half, f.start, f.acceleration, f.dt);
    Flight point = f;
    point.half = Vec3::Zero();
    const Bounds path = sampled(point, 2000);
    const double radius = f.half.norm();
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(box.low[i], path.low[i] - radius - 1e-5)
          << "m, axis " << i << ": a ball around the block, carried along, reaches no farther down";
      EXPECT_LE(box.high[i], path.high[i] + radius + 1e-5)
          << "m, axis " << i << ": a ball around the block, carried along, reaches no farther up";
    }
  }
}

}  // namespace

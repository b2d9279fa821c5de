// Exercise 6.2: numbers that can be found on paper, and a slide in a million small steps.
#include "ex02_stop_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace {

using namespace fc::exercises;

constexpr double kMu = 0.5, kGravity = 10;          // m/s^2: v^2 / 10 is the way
constexpr double kDegree = std::numbers::pi / 180;  // rad

Vec2 at(double degrees, double speed = 1) {
  return speed * Vec2(std::cos(degrees * kDegree), std::sin(degrees * kDegree));
}

void expect_near(const Vec2& got, const Vec2& expected, double tolerance, const char* meaning) {
  EXPECT_LE((got - expected).norm(), tolerance)
      << "m: (" << got.transpose() << "), expected (" << expected.transpose() << "): " << meaning;
}

TEST(Ex06StopPoints, TheConeKnowsNoAxes) {
  for (int degrees = 0; degrees < 360; degrees += 15)
    expect_near(stop_by_cone(at(degrees, 3), kMu, kGravity), 0.9 * at(degrees), 1e-14,
                "v^2 / (2 mu g), along v");
  expect_near(stop_by_cone(Vec2::Zero(), kMu, kGravity), Vec2::Zero(), 0, "it stands");
}

TEST(Ex06StopPoints, TheBoxBrakesDiagonalsTooMuch) {
  expect_near(stop_by_box({3, 0}, kMu, kGravity), {0.9, 0}, 1e-15, "along an axis it is right");
  expect_near(stop_by_box({0, -3}, kMu, kGravity), {0, -0.9}, 1e-15, "backwards, too");
  expect_near(stop_by_box(at(45), kMu, kGravity), std::sqrt(0.5) * 0.1 * at(45), 1e-15,
              "at 45 degrees: 0.707 of the way");
  expect_near(stop_by_box({-1, 0.8}, kMu, kGravity), {-0.1, 0.064}, 1e-15,
              "each axis for itself: it turns to the longer one");
}

TEST(Ex06StopPoints, TheDiamondTooLittle) {
  expect_near(stop_by_pyramid({3, 0}, kMu, kGravity, 4), {0.9, 0}, 1e-14, "along an axis it is right");
  expect_near(stop_by_pyramid(at(45), kMu, kGravity, 4), std::sqrt(2) * 0.1 * at(45), 1e-14,
              "at 45 degrees: 1.414 of the way");
  // (1, 0.8): the first component alone is braked, until it is 0.8; then both, by half each.
  expect_near(stop_by_pyramid({1, 0.8}, kMu, kGravity, 4), {0.036 + 0.128, 0.032 + 0.128}, 1e-14,
              "the larger component first, then both alike");
}

TEST(Ex06StopPoints, TheWorstDirections) {
  double box = 0, box_at = 0, diamond = 0, diamond_at = 0;
  for (int k = 1; k < 4500; ++k) {
    const Vec2 v = at(0.01 * k);
    const Error by_box = error_of(stop_by_box(v, kMu, kGravity), v, kMu, kGravity);
    const Error by_diamond = error_of(stop_by_pyramid(v, kMu, kGravity, 4), v, kMu, kGravity);
    ASSERT_LE(by_box.angle, 1e-12) << "rad, at " << 0.01 * k << " degrees: the box turns a slide to the axis";
    ASSERT_GE(by_diamond.angle, -1e-12)
        << "rad, at " << 0.01 * k << " degrees: the diamond turns a slide to the diagonal";
    if (by_box.angle < box) {
      box = by_box.angle;
      box_at = 0.01 * k;
    }
    if (by_diamond.angle > diamond) {
      diamond = by_diamond.angle;
      diamond_at = 0.01 * k;
    }
  }
  EXPECT_NEAR(box / kDegree, -12.79, 0.005) << "degrees";
  EXPECT_NEAR(box_at, 23.5, 0.1) << "degrees: where";
  EXPECT_NEAR(diamond / kDegree, 12.79, 0.005) << "degrees";
  EXPECT_NEAR(diamond_at, 21.5, 0.1) << "degrees: where";
}

TEST(Ex06StopPoints, ErrorsHaveASign) {
  const Error turned = error_of(0.2 * at(100), at(70), kMu, kGravity);
  EXPECT_NEAR(turned.angle, 30 * kDegree, 1e-14) << "rad: counter-clockwise";
  EXPECT_NEAR(turned.length, 2, 1e-14) << "0.2 m in the place of 0.1 m";
  EXPECT_NEAR(error_of(at(-170), at(170), kMu, kGravity).angle, 20 * kDegree, 1e-14)
      << "rad: over the half circle";
}

TEST(Ex06StopPoints, APyramidIsSymmetric) {
  for (const int corners : {4, 6, 8, 10, 16})
    for (double degrees = 1; degrees < 360; degrees += 7.3) {
      const Vec2 way = stop_by_pyramid(at(degrees, 2), kMu, kGravity, corners);
      const Vec2 mirrored = stop_by_pyramid(at(-degrees, 2), kMu, kGravity, corners);
      ASSERT_LE((mirrored - Vec2(way[0], -way[1])).norm(), 1e-13)
          << "m, " << corners << " corners, " << degrees << " degrees: mirrored";
      const double turn = 360. / corners;
      const Vec2 turned = stop_by_pyramid(at(degrees + turn, 2), kMu, kGravity, corners);
      const Error before = error_of(way, at(degrees), kMu, kGravity),
                  after = error_of(turned, at(degrees + turn), kMu, kGravity);
      ASSERT_NEAR(after.angle, before.angle, 1e-12)
          << "rad, " << corners << " corners, " << degrees << " degrees: from corner to corner";
      ASSERT_NEAR(after.length, before.length, 1e-12);
    }
}

// Small steps, each against the corner that takes most power.
TEST(Ex06StopPoints, AsSmallStepsHaveIt) {
  for (const int corners : {4, 6, 8, 12})
    for (const double degrees : {3.0, 17.0, 40.0, 111.0, 200.0, 301.0}) {
      Vec2 v = at(degrees), way = Vec2::Zero();
      const double dt = 1e-5;
      while (v.norm() > 2 * kMu * kGravity * dt) {
        Vec2 corner = Vec2::Zero();
        for (int k = 0; k < corners; ++k)
          if (const Vec2 other = at(360. * k / corners); other.dot(v) > corner.dot(v)) corner = other;
        v -= dt * kMu * kGravity * corner;
        way += dt * v;
      }
      const Vec2 got = stop_by_pyramid(at(degrees), kMu, kGravity, corners);
      ASSERT_LE((got - way).norm(), 5e-5)
          << "m, " << corners << " corners, " << degrees << " degrees: (" << got.transpose()
          << "), and in small steps (" << way.transpose() << ")";
    }
}

TEST(Ex06StopPoints, ManyCornersComeNear) {
  for (const int corners : {16, 64, 256})
    for (double degrees = 0; degrees < 90; degrees += 0.7) {
      const Error error =
          error_of(stop_by_pyramid(at(degrees), kMu, kGravity, corners), at(degrees), kMu, kGravity);
      ASSERT_LE(std::abs(error.angle), std::numbers::pi / corners)
          << "rad, " << corners << " corners, " << degrees << " degrees";
      ASSERT_GE(error.length, 1 - 1e-12)
          << corners << " corners: friction inside of the circle is never more than the circle's";
      ASSERT_LE(error.length, 1 / std::cos(std::numbers::pi / corners) + 1e-12)
          << corners << " corners, " << degrees << " degrees";
    }
}

TEST(Ex06StopPoints, HowManyCorners) {
  EXPECT_EQ(corners_for(45 * kDegree), 4) << "the diamond is off by up to 45 degrees at an instant";
  EXPECT_EQ(corners_for(44 * kDegree), 6) << "an even number";
  EXPECT_EQ(corners_for(90 * kDegree), 4) << "no fewer";
  EXPECT_EQ(corners_for(1 * kDegree), 180) << "for one degree";
  EXPECT_EQ(corners_for(0.99 * kDegree), 182);
}

TEST(Ex06StopPoints, OddPyramidsAreRefused) {
  EXPECT_THROW(stop_by_pyramid({1, 0}, kMu, kGravity, 5), std::invalid_argument);
  EXPECT_THROW(stop_by_pyramid({1, 0}, kMu, kGravity, 2), std::invalid_argument);
  EXPECT_THROW(stop_by_pyramid({1, 0}, kMu, kGravity, -4), std::invalid_argument);
  expect_near(stop_by_pyramid(Vec2::Zero(), kMu, kGravity, 6), Vec2::Zero(), 0, "it stands");
}

}  // namespace

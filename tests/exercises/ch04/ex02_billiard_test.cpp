// Exercise 4.2. In an ellipse the product of the angular momenta about the foci never changes, and a circle
// has chords of equal length.
#include "ex02_billiard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using fc::exercises::Bounce;
using fc::exercises::Ellipse;
using fc::exercises::next_bounce;
using fc::exercises::reflect;
using fc::exercises::Vec2;

double cross(const Vec2& x, const Vec2& y) {
  return x.x() * y.y() - x.y() * y.x();
}
double wall_error(const Ellipse& wall, const Vec2& x) {
  return std::abs(x.cwiseQuotient(Vec2(wall.a, wall.b)).squaredNorm() - 1);
}

TEST(Ex02Billiard, StraightAcross) {
  const Ellipse wall{2, 1};
  const Bounce b = next_bounce(wall, {0, 0}, {4, 0});
  EXPECT_NEAR(b.time, 0.5, 1e-15) << "s: 2 m from the middle to the wall, at 4 m/s";
  EXPECT_NEAR((b.place - Vec2(2, 0)).norm(), 0, 1e-15) << "m, from the end of the long axis, (2, 0)";
  const Bounce back = next_bounce(wall, b.place, {-4, 0});
  EXPECT_NEAR(back.time, 1, 1e-15)
      << "s: the whole axis, 4 m at 4 m/s; the bounce just left is not the next one";
  EXPECT_NEAR((back.place + Vec2(2, 0)).norm(), 0, 1e-15) << "m, from the axis' other end, (-2, 0)";
}

TEST(Ex02Billiard, ReflectsAtTheWallsNormal) {
  const Ellipse wall{2, 1};
  const Vec2 place(2 * std::cos(1.0), std::sin(1.0));
  const Vec2 along = Vec2(-2 * std::sin(1.0), std::cos(1.0)).normalized(), velocity(0.7, 1.9);
  const Vec2 after = reflect(wall, place, velocity);
  EXPECT_NEAR(after.norm(), velocity.norm(), 1e-14) << "m/s: an elastic bounce keeps the speed";
  EXPECT_NEAR(after.dot(along), velocity.dot(along), 1e-14) << "m/s along the wall: that part stays as it is";
  const Vec2 across(along.y(), -along.x());
  EXPECT_NEAR(after.dot(across), -velocity.dot(across), 1e-14)
      << "m/s across the wall: that part is reversed";
}

// A circle: every chord is as long as the first, and takes the same time.
TEST(Ex02Billiard, ACircleHasEqualChords) {
  const Ellipse wall{3, 3};
  Vec2 x(3, 0), v(-1, 2);
  const double chord = next_bounce(wall, x, v).time;
  EXPECT_NEAR(chord, 2 * 3 / std::sqrt(5.0) / std::sqrt(5.0), 1e-14) << "s: 2 r cos(angle) / speed";
  for (int i = 0; i < 1000; ++i) {
    const Bounce b = next_bounce(wall, x, v);
    ASSERT_NEAR(b.time, chord, 1e-11) << "s, chord " << i << ": in a circle all are as long as the first";
    x = b.place;
    v = reflect(wall, x, v);
  }
}

// Joachimsthal's integral in its mechanical form: L1 L2 about the two foci. Ten thousand bounces each.
TEST(Ex02Billiard, TheFociKeepTheirProduct) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 10; ++trial) {
    const Ellipse wall{2, 1.2};
    const Vec2 focus(std::sqrt(wall.a * wall.a - wall.b * wall.b), 0);
    Vec2 x(0.8 * any(random), 0.5 * any(random)), v = Vec2(any(random), any(random)).normalized();
    const auto product = [&] { return cross(x - focus, v) * cross(x + focus, v); };
    const double start = product();
    for (int i = 0; i < 10'000; ++i) {
      const Bounce b = next_bounce(wall, x, v);
      ASSERT_GT(b.time, 0) << "s: bounce " << i << " found the place it came from";
      x = b.place;
      v = reflect(wall, x, v);
      ASSERT_LE(wall_error(wall, x), 1e-14)
          << "of x^2/a^2 + y^2/b^2 less 1: bounce " << i << " is off the wall";
      ASSERT_NEAR(product(), start, 1e-9)
          << "m^4/s^2 after bounce " << i << ": the angular momenta about the two foci keep their product";
    }
    EXPECT_NEAR(v.norm(), 1, 1e-10) << "m/s: elastic bounces keep the speed";
  }
}

TEST(Ex02Billiard, ThroughOneFocusAndThenTheOther) {
  const Ellipse wall{5, 3};  // foci at -4 and 4
  Vec2 x(-4, 0), v(1, 2);
  for (int i = 0; i < 6; ++i) {
    const Vec2 next_focus(i % 2 == 0 ? 4 : -4, 0);
    const Bounce b = next_bounce(wall, x, v);
    v = reflect(wall, b.place, v);
    EXPECT_NEAR(cross(next_focus - b.place, v.normalized()), 0, 1e-9) << "m: by so much it misses the focus";
    x = b.place;
  }
}

// Whispering along the wall: chords of a millionth and less are chords all the same.
TEST(Ex02Billiard, ShortChordsAreNotLost) {
  const Ellipse wall{1, 1};
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Bounce b = next_bounce(wall, {1, 0}, {-std::sin(angle), std::cos(angle)});
    EXPECT_NEAR(b.time, 2 * std::sin(angle), 1e-15 + 1e-6 * angle)
        << "s: the chord at " << angle << " rad to the wall";
  }
}

// Not at the axes' ends, where a place on the wall is exact, but anywhere: there x^2/a^2 + y^2/b^2 is 1 only
// up to rounding, and that must not become a part of the chord.
TEST(Ex02Billiard, GrazingRaysFromTheWall) {
  const Ellipse wall{2, 1.2};
  const Vec2 half(wall.a, wall.b);
  for (const double angle : {1e-2, 1e-4, 1e-6, 1e-8}) {
    for (int i = 0; i < 200; ++i) {
      const double at = 0.01 + 0.031 * i;
      const Vec2 place = Vec2(std::cos(at), std::sin(at)).cwiseProduct(half);
      // So that it gets to the other end, which is 2 angle further round the ellipse, in one second.
      const Vec2 velocity =
          2 * std::sin(angle) * Vec2(-std::sin(at + angle), std::cos(at + angle)).cwiseProduct(half);
      const Bounce b = next_bounce(wall, place, velocity);
      ASSERT_NEAR(b.time, 1, 1e-12 + 4e-15 / angle)
          << "s: the chord from " << place.transpose() << " m at " << angle
          << " rad to the wall; the place on the wall is taken for one off it";
      ASSERT_LE(wall_error(wall, b.place), 1e-14)
          << "of x^2/a^2 + y^2/b^2 less 1: the bounce is off the wall";
    }
  }
}

TEST(Ex02Billiard, WhispersForTenThousandBounces) {
  const Ellipse wall{1, 1};
  constexpr double kAngle = 1e-6;  // rad to the wall
  Vec2 x(1, 0), v(-std::sin(kAngle), std::cos(kAngle));
  for (int i = 0; i < 10'000; ++i) {
    const Bounce b = next_bounce(wall, x, v);
    ASSERT_NEAR(b.time, 2 * kAngle, 1e-6 * kAngle) << "s, chord " << i << ": all are as long as the first";
    x = b.place;
    v = reflect(wall, x, v);
  }
}

TEST(Ex02Billiard, OutwardsFromTheWallIsNow) {
  const Ellipse wall{2, 1};
  EXPECT_NEAR(next_bounce(wall, {2, 0}, {1, 0.3}).time, 0, 1e-15) << "s: it is at the wall, and goes into it";
  EXPECT_NEAR(next_bounce(wall, {0, -1}, {0.2, -3}).time, 0, 1e-15)
      << "s: it is at the wall, and goes into it";
}

TEST(Ex02Billiard, HoweverSlowOrFast) {
  const Ellipse wall{2, 1.2};
  const Vec2 inside(0.3, -0.4), on(0, 1.2), velocity(0.7, -1.1);
  for (const Vec2& place : {inside, on}) {
    const Bounce usual = next_bounce(wall, place, velocity);
    for (const double factor : {1e-300, 1e-170, 1e-9, 1e9, 1e170, 1e300}) {
      const Bounce b = next_bounce(wall, place, factor * velocity);
      EXPECT_NEAR(b.time * factor / usual.time, 1, 1e-14)
          << "of the time it should take: at " << factor
          << " times the speed; the square of the speed may be no double";
      EXPECT_NEAR((b.place - usual.place).norm(), 0, 1e-14)
          << "m: the path is the same, however long it takes";
    }
  }
}

}  // namespace

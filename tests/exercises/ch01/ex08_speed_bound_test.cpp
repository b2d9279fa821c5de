// Exercise 1.8. A bound is never exceeded, and is not larger than it has to be.
#include "ex08_speed_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using fc::Vec3;
using fc::mine::Mover;

Mover mover(const Vec3& velocity, const Vec3& spin = Vec3::Zero(), double reach = 1,
            const Vec3& acceleration = Vec3::Zero()) {
  return {velocity, acceleration, spin, reach};
}

TEST(Ex08SpeedBound, StraightFlight) {
  EXPECT_NEAR(fc::mine::speed_bound(Vec3::UnitX(), mover({2, 5, 0}), mover({-1, 0, 7}), 1), 3, 1e-14)
      << "m/s: A comes with 2 along n, B with 1 against it; what they do across n does not matter";
  EXPECT_NEAR(fc::mine::speed_bound(Vec3::UnitX(), mover({-2, 0, 0}), mover({1, 0, 0}), 1), -3, 1e-14)
      << "m/s: they part with 3. A bound below 0 proves a miss, so do not cut it off at 0";
}

TEST(Ex08SpeedBound, ABodyThatSpins) {
  EXPECT_NEAR(fc::mine::speed_bound(Vec3::UnitX(), mover({0, 0, 0}, {0, 0, 3}, 0.5), mover({0, 0, 0}), 1),
              1.5, 1e-14)
      << "m/s: 3 rad/s across n, and a reach of 0.5 m";
  EXPECT_NEAR(fc::mine::speed_bound(Vec3::UnitX(), mover({0, 0, 0}), mover({0, 0, 0}, {0, 4, 0}, 0.25), 1), 1,
              1e-14)
      << "m/s: B's points can come towards A, too";
}

TEST(Ex08SpeedBound, SpinAboutTheNormalBringsNothingNearer) {
  EXPECT_NEAR(fc::mine::speed_bound(Vec3::UnitX(), mover({1, 0, 0}, {1000, 0, 0}, 2), mover({0, 0, 0}), 1), 1,
              1e-11)
      << "m/s: points that turn about n do not move along it. With |w| in place of |n x w| this would be 2001";
}

TEST(Ex08SpeedBound, ALateFallCounts) {
  EXPECT_NEAR(
      fc::mine::speed_bound(-Vec3::UnitZ(), mover({0, 0, 0}, {0, 0, 0}, 1, {0, 0, -10}), mover({0, 0, 0}), 2),
      20, 1e-13)
      << "m/s: A falls for 2 s at 10 m/s^2 towards B: the bound must hold at the end, too";
  EXPECT_NEAR(
      fc::mine::speed_bound(-Vec3::UnitZ(), mover({0, 0, -5}, {0, 0, 0}, 1, {0, 0, 10}), mover({0, 0, 0}), 2),
      5, 1e-13)
      << "m/s: A is slowed down: it is fastest now";
}

TEST(Ex08SpeedBound, FallingTogetherIsNotFalling) {
  const Vec3 gravity(0, 0, -9.81);
  EXPECT_NEAR(fc::mine::speed_bound(-Vec3::UnitZ(), mover({0, 0, 0}, {0, 0, 0}, 1, gravity),
                                    mover({0, 0, -1}, {0, 0, 0}, 1, gravity), 10),
              -1, 1e-12)
      << "m/s: both have the same acceleration: subtract before you bound";
}

TEST(Ex08SpeedBound, NoPointIsFaster) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> gauss;
  const auto vec = [&] { return Vec3(gauss(random), gauss(random), gauss(random)); };
  for (int round = 0; round < 2000; ++round) {
    const Vec3 n = vec().normalized();
    const Mover a =
        mover(vec(), 3 * vec(), std::abs(gauss(random)) + 0.1, round % 2 ? vec() : Vec3(Vec3::Zero()));
    const Mover b =
        mover(vec(), 3 * vec(), std::abs(gauss(random)) + 0.1, round % 3 ? vec() : Vec3(Vec3::Zero()));
    const double duration = std::abs(gauss(random));
    const double bound = fc::mine::speed_bound(n, a, b, duration);
    for (int k = 0; k < 8; ++k) {
      const double t = duration * k / 7;
      const Vec3 r_a = a.reach * vec().normalized(),
                 r_b = b.reach * vec().normalized();  // wherever they have turned to
      const Vec3 v_a = a.velocity + t * a.acceleration + a.spin.cross(r_a),
                 v_b = b.velocity + t * b.acceleration + b.spin.cross(r_b);
      ASSERT_LE(n.dot(v_a - v_b), bound + 1e-12) << "m/s: two points close in faster than the bound, " << t
                                                 << " s from now: an advance would step through";
    }
  }
}

TEST(Ex08SpeedBound, IsAttained) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> gauss;
  const auto vec = [&] { return Vec3(gauss(random), gauss(random), gauss(random)); };
  for (int round = 0; round < 500; ++round) {
    const Vec3 n = vec().normalized();
    const Mover a = mover(vec(), 3 * vec(), 0.7, vec()), b = mover(vec(), 3 * vec(), 0.4, vec());
    const double duration = std::abs(gauss(random));
    // The points that are fastest along n, and the later or the earlier end.
    const Vec3 r_a = a.reach * n.cross(a.spin).normalized(), r_b = -b.reach * n.cross(b.spin).normalized();
    double most = -1e300;
    for (const double t : {0.0, duration})
      most = std::max(most, n.dot(a.velocity + t * a.acceleration + a.spin.cross(r_a) -
                                  (b.velocity + t * b.acceleration + b.spin.cross(r_b))));
    ASSERT_NEAR(fc::mine::speed_bound(n, a, b, duration), most, 1e-11)
        << "m/s: two points can be as fast as that, and none faster. A larger bound is safe, and costs advances";
  }
}

}  // namespace

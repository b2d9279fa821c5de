// Exercise 1.1. The tests know the true speeds: a corner that turns about a line moves on a circle.
#include "ex01_door.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using fc::Vec3;
using fc::exercises::Door;
using fc::exercises::door_speed_bound;

// Where a corner is at time s, and how fast it moves along n.
double speed_along(const Door& door, const Vec3& corner, const Vec3& n, double s) {
  const double angle = door.spin * s + 0.5 * door.spin_up * s * s;
  const Vec3 r = Eigen::AngleAxisd(angle, door.axis) * (corner - door.hinge);
  return (door.spin + door.spin_up * s) * n.dot(door.axis.cross(r));
}
double fastest(const Door& door, const Vec3& n, double t, double end) {
  double speed = 0;
  for (const Vec3& corner : door.corners)
    for (int k = 0; k <= 2000; ++k)
      speed = std::max(speed, speed_along(door, corner, n, t + (end - t) * k / 2000));
  return speed;
}

// 1 m wide and 2 m high, hinged along a vertical line at x = 3 m.
Door front_door(double spin, double spin_up = 0) {
  return {{3, 0, 0}, Vec3::UnitZ(), spin, spin_up, {{3, 0, 0}, {4, 0, 0}, {4, 0, 2}, {3, 0, 2}}};
}

TEST(Ex01Door, IsNeverExceeded) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vec = [&] { return Vec3(u(random), u(random), u(random)); };
  for (int trial = 0; trial < 300; ++trial) {
    Door door{3 * vec(), vec().normalized(), 4 * u(random), 6 * u(random), {}};
    for (int k = 0; k < 4; ++k) door.corners.push_back(door.hinge + vec());
    const Vec3 n = vec().normalized();
    const double t = u(random) + 1, end = t + u(random) + 1;
    const double bound = door_speed_bound(door, n, t, end), truth = fastest(door, n, t, end);
    ASSERT_GE(bound, truth * (1 - 1e-12))
        << "the bound of the closing speed is " << bound << " m/s, but a corner moves with " << truth
        << " m/s: an advance that trusts the bound can step through what the door hits";
  }
}

TEST(Ex01Door, IsReachedByADoorThatTurnsFarEnough) {
  const Vec3 n = Vec3(3, 4, 0) / 5;
  const double bound = door_speed_bound(front_door(2), n, 0, 10), truth = 2.0;  // 2 rad/s, 1 m from the hinge
  EXPECT_NEAR(bound, truth, 1e-12) << "expected 2 m/s (2 rad/s times the width of 1 m), got " << bound
                                   << " m/s: a bound that is too large is safe, but costs advances";
  const Vec3 slanted = Vec3(0, 3, 4) / 5;  // only the part across the hinge counts: 3/5
  EXPECT_NEAR(door_speed_bound(front_door(2), slanted, 0, 10), 1.2, 1e-12) << "m/s along a slanted normal";
}

TEST(Ex01Door, IsZeroAlongTheHinge) {
  const double bound = door_speed_bound(front_door(5), Vec3::UnitZ(), 0, 1);
  EXPECT_NEAR(bound, 0, 1e-12) << "got " << bound << " m/s, but a door does not move along its hinge";
}

TEST(Ex01Door, IsTheSameWhereverOnItsLineTheHingeIs) {
  Door door = front_door(2);
  const double here = door_speed_bound(door, Vec3::UnitY(), 0, 1);
  door.hinge += 50 * door.axis;
  const double there = door_speed_bound(door, Vec3::UnitY(), 0, 1);
  EXPECT_NEAR(here, there, 1e-12) << "m/s: two points of one hinge describe the same motion";
  EXPECT_NEAR(there, 2, 1e-12)
      << "m/s: 2 rad/s, 1 m from the hinge's line; how high on it `hinge` is does not matter";
}

TEST(Ex01Door, SeesASpinThatGrows) {
  const double bound = door_speed_bound(front_door(1, 2), Vec3::UnitY(), 0, 3);
  EXPECT_NEAR(bound, 7, 1e-12) << "at the end, after 3 s of 2 rad/s^2, the door turns with 7 rad/s; got "
                               << bound << " m/s";
}

TEST(Ex01Door, SeesASpinThatBrakes) {
  const double bound = door_speed_bound(front_door(6, -2), Vec3::UnitY(), 0, 3);
  EXPECT_NEAR(bound, 6, 1e-12) << "the door comes to rest at the end and is fastest now: 6 rad/s; got "
                               << bound << " m/s";
}

TEST(Ex01Door, SeesASpinThatReverses) {
  const double bound = door_speed_bound(front_door(1, -4), Vec3::UnitY(), 0, 1);
  EXPECT_NEAR(bound, 3, 1e-12) << "the door swings back, at the end with 3 rad/s; got " << bound << " m/s";
}

TEST(Ex01Door, ForgetsWhatIsOver) {
  const double bound = door_speed_bound(front_door(6, -2), Vec3::UnitY(), 2, 3);
  EXPECT_NEAR(bound, 2, 1e-12) << "from t = 2 s on the door turns with at most 2 rad/s; got " << bound
                               << " m/s: the bound is asked for the rest of the interval only";
}

// In long double, with hinges far along the line and normals nearly along it, where differences have few digits.
TEST(Ex01Door, NoPointExceedsItByTheLastDigitEither) {
  using Long = long double;
  using Long3 = Eigen::Matrix<Long, 3, 1>;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vec = [&] { return Vec3(u(random), u(random), u(random)); };
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 axis = vec().normalized();
    Door door{3 * vec(), axis, 4 * u(random), trial % 2 == 0 ? 0 : 6 * u(random), {}};
    for (int k = 0; k < 4; ++k) door.corners.push_back(door.hinge + vec());
    if (trial % 4 >= 2) door.hinge += 1000 * u(random) * axis;
    const Vec3 n = trial % 3 == 0 ? Vec3((axis + 1e-6 * vec()).normalized()) : Vec3(vec().normalized());
    const double t = u(random) + 1, end = t + u(random) + 1;

    const Long3 long_axis = axis.cast<Long>();
    Long across = 0, far = 0;
    for (const Vec3& corner : door.corners) {
      const Long3 r = corner.cast<Long>() - door.hinge.cast<Long>();
      across = std::max(across, r.cross(long_axis).norm() / long_axis.norm());
      far = std::max(far, r.norm());
    }
    const Long spin = std::max(std::abs(door.spin + Long(door.spin_up) * t),
                               std::abs(door.spin + Long(door.spin_up) * end));
    const Long truth = spin * n.cast<Long>().cross(long_axis).norm() * across;
    const Long excess = door_speed_bound(door, n, t, end) - truth;
    ASSERT_GE(excess, 0)
        << "m/s: by so much the bound is below " << truth << " m/s, a speed that a corner comes to if the "
        << "door turns far enough. Every operation may round down; a bound makes up for that";
    ASSERT_LE(excess, 1e-12L * (std::abs(door.spin) + std::abs(door.spin_up) * Long(end)) * far)
        << "m/s: by so much the bound is above " << truth
        << " m/s: safe, but rounding does not ask for that much";
  }
}

}  // namespace

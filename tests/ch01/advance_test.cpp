// First contacts whose time has a closed form, the five statuses, limits and wrong arguments.
#include "ch01_convex_advancement/advance.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using ca::Status;

ca::AdvanceResult ask(const Solid& a, const ca::Motion& ma, const Solid& b, const ca::Motion& mb,
                      ca::AdvanceOptions options = {}) {
  return ca::advance(a.convex(), ma, b.convex(), mb, options);
}

// Contact, not later than the truth, and earlier by no more than the tolerance at the closing speed there.
void expect_contact(const ca::AdvanceResult& r, double truth, double closing_speed, double tolerance = 1e-6) {
  EXPECT_EQ(r.status, Status::contact);
  EXPECT_LE(r.toc, truth);
  EXPECT_GE(r.toc, truth - 1.01 * tolerance / closing_speed);
  EXPECT_GT(r.gap_lower, 0);
  EXPECT_LE(r.gap_lower, r.gap_upper);
  EXPECT_LE(r.gap_upper, tolerance);
  EXPECT_EQ(r.features.size(), 1u);
}

const Quat along_x(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));   // turns z to x
const Quat along_y(Eigen::AngleAxisd(-std::numbers::pi / 2, Vec3::UnitX()));  // turns z to y

TEST(Advance, SpheresHeadOn) {
  const ca::Motion a = motion({-2, 0, 0}, Quat::Identity(), {3, 0, 0}, {4, 5, 6});
  const ca::Motion b = motion({2, 0, 0}, Quat::Identity(), {-1, 0, 0}, {-7, 0, 8});
  const ca::AdvanceResult r = ask(sphere(0.5), a, sphere(1), b);
  expect_contact(r, 2.5 / 4, 4);
  EXPECT_LT((r.features[0].normal - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((r.features[0].point_a - Vec3(-2 + 0.625 * 3 + 0.5, 0, 0)).norm(), 1e-6);
  EXPECT_LE(r.iterations, 2);  // a ball's spin closes nothing
}

TEST(Advance, SpheresThatMissOrPass) {
  const ca::Motion rest = motion({0, 0, 0});
  const auto flyby = [&](double offset) {
    return ask(sphere(0.5), rest, sphere(0.5), motion({-5, offset, 0}, Quat::Identity(), {10, 0, 0}));
  };
  EXPECT_EQ(flyby(1 + 1e-5).status, Status::separated);
  EXPECT_EQ(flyby(1.5).toc, 1);
  const double late = flyby(0.8).toc;  // sqrt(1 - 0.64) = 0.6 before the middle
  EXPECT_LE(late, 0.44);
  EXPECT_GE(late, 0.44 - 1e-6 / (10 * 0.6));
}

TEST(Advance, AFallingBoxAcceleratesOntoAFloor) {
  const Solid floor = box({100, 100, 1}), cube = box({1, 1, 1});
  const ca::Motion ground = motion({0, 0, -0.5});
  for (const double height : {1e-3, 1.0, 30.0}) {
    const ca::Motion fall =
        motion({3, 4, 0.5 + height}, Quat::Identity(), {1, 0, 0}, Vec3::Zero(), {0, 0, -9.81});
    ca::AdvanceOptions options;
    options.interval = 3;
    expect_contact(ask(floor, ground, cube, fall, options), std::sqrt(2 * height / 9.81),
                   std::sqrt(2 * 9.81 * height));
  }
  // Thrown up, it comes back: a bound from the speed at the start alone would call it separated.
  const ca::Motion thrown = motion({0, 0, 1}, Quat::Identity(), {0, 0, 5}, Vec3::Zero(), {0, 0, -9.81});
  ca::AdvanceOptions options;
  options.interval = 2;
  const double v = std::sqrt(25 + 2 * 9.81 * 0.5);
  expect_contact(ask(floor, ground, cube, thrown, options), (5 + v) / 9.81, v);
  EXPECT_EQ(
      ask(floor, motion({0, 0, -0.5}, Quat::Identity(), {0, 0, 0}, {0, 0, 0}, {0, 0, -9.81}), cube, thrown)
          .status,
      Status::separated);  // both fall: nothing closes in
}

TEST(Advance, ARodsTipMeetsAFace) {
  const double radius = 0.05, length = 2, rate = 3, wall = 0.7;
  const Solid rod = capsule(radius, length), face = box({1, 10, 10});
  const double angle = std::asin((wall - radius) / (length / 2));
  for (const ca::MotionBound bound : {ca::MotionBound::second_order, ca::MotionBound::projected,
                                      ca::MotionBound::directional, ca::MotionBound::naive}) {
    ca::AdvanceOptions options;
    options.bound = bound;
    const ca::AdvanceResult r = ask(rod, motion({0, 0, 0}, along_y, Vec3::Zero(), {0, 0, -rate}), face,
                                    motion({wall + 0.5, 0, 0}), options);
    expect_contact(r, angle / rate, rate * (length / 2) * std::cos(angle));
  }
}

TEST(Advance, ARodsSideMeetsAnEdge) {
  const double radius = 0.05, rate = 2, rho = 0.6, phi = std::numbers::pi / 3;
  const Solid rod = capsule(radius, 3), block = box({1, 1, 1});
  const ca::Motion at = motion({rho * std::cos(phi) - 0.5, rho * std::sin(phi) + 0.5, 0});
  const ca::AdvanceResult r = ask(rod, motion({0, 0, 0}, along_x, Vec3::Zero(), {0, 0, rate}), block, at);
  const double angle = phi - std::asin(radius / rho);
  expect_contact(r, angle / rate, rate * rho * std::cos(phi - angle));
  const Vec3 edge(rho * std::cos(phi), rho * std::sin(phi), 0);
  EXPECT_LT((r.features[0].point_b - edge).head<2>().norm(), 1e-5);
}

TEST(Advance, AScrewMovesInByItsThreadAlone) {
  const Solid floor = box({10, 10, 1});
  const Solid bolt = hull({{0.3, 0, -1}, {-0.2, 0.1, -0.9}, {0, 0.5, 1}, {-0.4, -0.3, 0.8}, {0.2, 0.2, 0.9}});
  const ca::Motion screw = motion({0, 0, 1.5}, Quat::Identity(), {0, 0, -1}, {0, 0, 40});
  const ca::AdvanceResult r = ask(floor, motion({0, 0, -0.5}), bolt, screw);
  expect_contact(r, 0.5, 1);
  EXPECT_LE(r.iterations, 2);  // the directional bound does not see the spin
}

TEST(Advance, TouchingStarts) {
  const Solid cube = box({1, 1, 1});
  for (const Vec3& velocity : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 0, 0)})
    for (const double gap : {0.0, 5e-7, -5e-7}) {
      const ca::AdvanceResult r =
          ask(cube, motion({0, 0, 0}), cube, motion({0.1, 0.2, 1 + gap}, Quat::Identity(), velocity));
      EXPECT_EQ(r.status, Status::touching_at_start) << gap;
      EXPECT_EQ(r.toc, 0);
      EXPECT_EQ(r.features.size(), 1u);
      EXPECT_NEAR(r.features[0].normal.z(), 1, 1e-9);
      EXPECT_NEAR(r.features[0].point_a.z(), 0.5, 1e-12);
      EXPECT_NEAR(r.features[0].point_b.z(), 0.5 + gap, 1e-12);
      EXPECT_NEAR(r.features[0].gap, gap, 1e-9);
    }
  EXPECT_EQ(ask(sphere(1), motion({0, 0, 0}), sphere(1), motion({2, 0, 0})).status,
            Status::touching_at_start);
}

TEST(Advance, PenetratingStarts) {
  const Solid cube = box({1, 1, 1});
  for (const double depth : {1e-5, 0.1, 1.0}) {
    const ca::AdvanceResult r =
        ask(cube, motion({0, 0, 0}), cube, motion({0, 0, 1 - depth}, Quat::Identity(), {0, 0, 1}));
    EXPECT_EQ(r.status, Status::penetrating_at_start) << depth;
    EXPECT_EQ(r.toc, 0);
    EXPECT_EQ(r.gap_upper, 0);
    EXPECT_LT(r.gap_lower, -1e-6);
    EXPECT_TRUE(std::isfinite(r.gap_lower)) << depth;
  }
  for (const double x : {0.0, 0.5, 1.9}) {
    const ca::AdvanceResult r = ask(sphere(1), motion({0, 0, 0}), sphere(1), motion({x, 0, 0}));
    EXPECT_EQ(r.status, Status::penetrating_at_start) << x;
    EXPECT_TRUE(std::isfinite(r.gap_lower)) << x;
  }
}

// Just above a face: away and along it is proved clear in a step or two, towards it is a contact.
TEST(Advance, NearStarts) {
  const Solid cube = box({1, 1, 1});
  const auto near = [&](const Vec3& velocity) {
    return ask(cube, motion({0, 0, 0}), cube, motion({0.1, 0.2, 1 + 2e-6}, Quat::Identity(), velocity));
  };
  for (const Vec3& velocity : {Vec3(0, 0, 3), Vec3(0.2, 0, 0), Vec3(0, 0, 0), Vec3(1, 1, 1e-9)}) {
    EXPECT_EQ(near(velocity).status, Status::separated);
    EXPECT_LE(near(velocity).iterations, 2);
  }
  expect_contact(near({0, 0, -1}), 2e-6, 1);
}

TEST(Advance, ALimitMeansClearUntilThen) {
  const Solid rod = capsule(0.05, 2), face = box({1, 10, 10});
  const ca::Motion turning = motion({0, 0, 0}, along_y, Vec3::Zero(), {0, 0, -3}), wall = motion({1.2, 0, 0});
  const double truth = std::asin(0.65) / 3;
  double last = 0;
  for (const int limit : {0, 1, 2, 3}) {
    ca::AdvanceOptions options;
    options.max_iterations = limit;
    const ca::AdvanceResult r = ask(rod, turning, face, wall, options);
    EXPECT_EQ(r.status, Status::unresolved);
    EXPECT_EQ(r.iterations, limit);
    EXPECT_LT(r.toc, truth);
    EXPECT_TRUE(limit == 0 || r.toc > last);
    EXPECT_GT(r.gap_lower, 0);
    last = r.toc;
  }
}

TEST(Advance, ToleranceBelowRoundingIsRaised) {
  for (const double tolerance : {0.0, 1e-30, 1e-17}) {
    ca::AdvanceOptions options;
    options.tolerance = tolerance;
    const ca::Motion b = motion({5, 0.1, 0.2}, Quat(1, 2, 3, 4).normalized(), {-5, 0, 0}, {1, 1, 1});
    const ca::AdvanceResult r = ask(box({1, 1, 1}), motion({0, 0, 0}), box({1, 1, 1}), b, options);
    EXPECT_EQ(r.status, Status::contact);
    EXPECT_GT(r.tolerance, 1e-15);
    EXPECT_LT(r.tolerance, 1e-12);
    EXPECT_LE(r.gap_upper, r.tolerance);
  }
}

TEST(Advance, AnEmptyIntervalAsksAboutTheStart) {
  ca::AdvanceOptions options;
  options.interval = 0;
  EXPECT_EQ(ask(sphere(1), motion({0, 0, 0}), sphere(1), motion({3, 0, 0}), options).status,
            Status::separated);
  EXPECT_EQ(ask(sphere(1), motion({0, 0, 0}), sphere(1), motion({2, 0, 0}), options).status,
            Status::touching_at_start);
}

TEST(Advance, WrongArgumentsThrow) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const Solid ball = sphere(1);
  const ca::Motion good = motion({3, 0, 0});
  for (const double bad : {nan, inf, -1.0}) {
    ca::AdvanceOptions options;
    options.interval = bad;
    EXPECT_THROW(ask(ball, motion({0, 0, 0}), ball, good, options), std::invalid_argument);
    options = {};
    options.tolerance = bad;
    EXPECT_THROW(ask(ball, motion({0, 0, 0}), ball, good, options), std::invalid_argument);
  }
  for (const double bad : {nan, inf}) {
    const Vec3 v(0, bad, 0);
    EXPECT_THROW(ask(ball, motion(v), ball, good), std::invalid_argument);
    EXPECT_THROW(ask(ball, good, ball, motion({0, 0, 0}, Quat::Identity(), v)), std::invalid_argument);
    EXPECT_THROW(ask(ball, good, ball, motion({0, 0, 0}, Quat::Identity(), {0, 0, 0}, v)),
                 std::invalid_argument);
    EXPECT_THROW(ask(ball, good, ball, motion({0, 0, 0}, Quat::Identity(), {0, 0, 0}, {0, 0, 0}, v)),
                 std::invalid_argument);
  }
  EXPECT_THROW(ca::motion_bound_named("fastest"), std::invalid_argument);
}

}  // namespace

// Exercise 1.9. Times of contact are known for balls and for a rod; of all others the certificate is followed.
#include "ex09_advance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ch01_convex_advancement/advance.hpp"
#include "common/rigid_body.hpp"

namespace {

using fc::Mat3;
using fc::Vec3;
namespace ca = fc::ca;
namespace clear = fc::ca::clear;
using ca::Status;

ca::Motion motion(const Vec3& position, const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero(),
                  const Vec3& acceleration = Vec3::Zero(), const Mat3& rotation = Mat3::Identity()) {
  fc::RigidBody body;
  body.position = position;
  body.velocity = velocity;
  body.spin = spin;
  body.orientation = fc::Quat(rotation);
  return ca::Motion(body, acceleration);
}

ca::ConvexCore ball() {
  return ca::ConvexCore({Vec3::Zero()});
}

ca::ConvexCore box(const Vec3& size) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(0.5 * size.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return ca::ConvexCore(corners);
}

ca::AdvanceOptions options(double interval, double tolerance = 1e-6) {
  ca::AdvanceOptions o;
  o.interval = interval;
  o.tolerance = tolerance;
  o.certificate = true;
  return o;
}

ca::AdvanceResult ask(const ca::Convex& a, const ca::Motion& ma, const ca::Convex& b, const ca::Motion& mb,
                      const ca::AdvanceOptions& o) {
  return fc::mine::advance(a, ma, b, mb, o, clear::Pieces());
}

TEST(Ex09Advance, BallsMeetHeadOn) {
  const ca::ConvexCore core = ball();
  for (const double tolerance : {1e-2, 1e-6, 1e-10}) {
    const ca::AdvanceResult r = ask(core.convex(0.5), motion({0, 0, 0}), core.convex(0.5),
                                    motion({5, 0, 0}, {-2, 0, 0}), options(3, tolerance));
    EXPECT_EQ(r.status, Status::contact);
    EXPECT_LE(r.toc, 2.0) << "s: 4 m at 2 m/s. Later would be too late: they would overlap";
    EXPECT_GE(r.toc, 2.0 - tolerance / 2) << "s: they would still be more than the tolerance apart";
    EXPECT_GT(r.gap_lower, 0.3 * tolerance)
        << "m: at contact a plane is to be left. Where does each step aim?";
    EXPECT_LE(r.gap_upper, tolerance) << "m";
    EXPECT_EQ(r.features.size(), 1u) << "features: the two points that meet";
  }
}

TEST(Ex09Advance, ARodSwingsIntoAWall) {
  // Its end is at x = sin(2 t), the wall at x = 0.5: t = asin(0.5)/2.
  const ca::ConvexCore rod({{0, 1, 0}, {0, -1, 0}}), wall = box({1, 4, 4});
  const ca::AdvanceResult r = ask(rod.convex(0), motion({0, 0, 0}, {0, 0, 0}, {0, 0, -2}), wall.convex(0),
                                  motion({1, 0, 0}), options(1));
  EXPECT_EQ(r.status, Status::contact);
  EXPECT_LE(r.toc, std::asin(0.5) / 2) << "s: never late";
  EXPECT_NEAR(r.toc, std::asin(0.5) / 2, 1e-6) << "s";
}

TEST(Ex09Advance, AMissIsProved) {
  const ca::ConvexCore core = ball();
  const ca::AdvanceResult r = ask(core.convex(0.5), motion({0, 0, 0}), core.convex(0.5),
                                  motion({5, 1.01, 0}, {-5, 0, 0}), options(2));
  EXPECT_EQ(r.status, Status::separated) << "B flies past, 1 cm away";
  EXPECT_EQ(r.toc, 2) << "s: clear until the interval's end";
  const ca::AdvanceResult away =
      ask(core.convex(0.5), motion({0, 0, 0}), core.convex(0.5), motion({2, 0, 0}, {1, 0, 0}), options(1000));
  EXPECT_EQ(away.status, Status::separated)
      << "B goes away: the speed bound is below 0, and not to be divided by";
  EXPECT_EQ(away.iterations, 1) << "advances: they part, so one plane proves all of it (mind a speed <= 0)";
}

TEST(Ex09Advance, ALimitIsNoMiss) {
  const ca::ConvexCore cube = box(Vec3::Ones());
  ca::AdvanceOptions few = options(2);
  few.max_iterations = 2;
  const ca::AdvanceResult r = ask(cube.convex(0), motion({0, 0, 0}), cube.convex(0),
                                  motion({3, 0.2, 0.1}, {-1.5, 0, 0}, {1, 2, 3}), few);
  EXPECT_EQ(r.status, Status::unresolved) << "after two advances nothing is decided";
  EXPECT_GT(r.toc, 0) << "s: but something is proved";
  EXPECT_EQ(r.iterations, 2) << "advances";
}

TEST(Ex09Advance, WhatTouchesAtTheStartIsToldSo) {
  const ca::ConvexCore cube = box(Vec3::Ones());
  const auto at = [&](double x) {
    return ask(cube.convex(0), motion({0, 0, 0}), cube.convex(0), motion({x, 0.1, 0}, {-1, 0, 0}),
               options(1));
  };
  EXPECT_EQ(at(1 + 1e-7).status, Status::touching_at_start) << "0.1 um apart, tolerance 1 um";
  EXPECT_EQ(at(1).status, Status::touching_at_start) << "exactly touching";
  EXPECT_EQ(at(0.9).status, Status::penetrating_at_start) << "10 cm deep";
  EXPECT_EQ(at(0.9).toc, 0) << "s";
  EXPECT_TRUE(at(0.9).certificate.empty()) << "nothing is proved of what overlaps";
}

int gaps_asked = 0, speeds_asked = 0;
clear::Gap counted_gap(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& pose, double accuracy,
                       clear::ClosestPointFunction* closest) {
  ++gaps_asked;
  EXPECT_LE(accuracy, 1e-6 / 4) << "m: a gap that is known less exactly than to a part of the tolerance";
  return clear::gap(a, b, pose, accuracy, closest);
}
double counted_speed(const Vec3& n, const clear::Mover& a, const clear::Mover& b, double duration) {
  ++speeds_asked;
  return 2 * clear::speed_bound(n, a, b, duration);  // a bound, too, and worse
}

TEST(Ex09Advance, AsksThePiecesThatItIsGiven) {
  const ca::ConvexCore core = ball();
  clear::Pieces pieces;
  pieces.gap = counted_gap;
  pieces.speed_bound = counted_speed;
  gaps_asked = speeds_asked = 0;
  const ca::AdvanceResult r = fc::mine::advance(core.convex(0.5), motion({0, 0, 0}), core.convex(0.5),
                                                motion({5, 0, 0}, {-2, 0, 0}), options(3), pieces);
  EXPECT_EQ(r.status, Status::contact);
  EXPECT_EQ(gaps_asked, r.distance_calls) << "gaps asked of pieces.gap, against those reported";
  EXPECT_GT(gaps_asked, 10) << "gaps: with twice the speed each advance halves the gap";
  EXPECT_EQ(speeds_asked, r.iterations) << "speeds asked of pieces.speed_bound, against advances";
}

// Bounds that are far apart, as those of a GJK that stopped early: half of a large gap is certified, of a small one all but a
// quarter of the tolerance.
clear::Gap gap_of_a_poor_plane(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& pose,
                               double accuracy, clear::ClosestPointFunction* closest) {
  clear::Gap g = clear::gap(a, b, pose, accuracy, closest);
  g.lower = g.lower > 1 ? g.lower / 2 : g.lower - 1e-6 / 4;
  return g;
}

TEST(Ex09Advance, EachBoundHasItsUse) {
  const ca::ConvexCore core = ball();
  clear::Pieces pieces;
  pieces.gap = gap_of_a_poor_plane;
  pieces.speed_bound = counted_speed;
  const ca::AdvanceResult r = fc::mine::advance(core.convex(0.5), motion({0, 0, 0}), core.convex(0.5),
                                                motion({5, 0, 0}, {-2, 0, 0}), options(3), pieces);
  EXPECT_EQ(r.status, Status::contact);
  ASSERT_FALSE(r.certificate.empty());
  EXPECT_LE(r.certificate[0].advance, 0.5)
      << "s: of a first gap of 4 m only 2 m are certified (`lower`), and the speed bound is 4 m/s. `upper` is the wrong bound to "
         "advance by";
  EXPECT_LE(r.gap_upper, 1e-6)
      << "m: a contact's witness points are within the tolerance: `upper` says so, `lower` does not";
}

TEST(Ex09Advance, AFallGetsFaster) {
  // 5 m at 10 m/s^2: 1 s.
  const ca::ConvexCore core = ball();
  const ca::AdvanceResult r = ask(core.convex(0.5), motion({0, 0, 0}), core.convex(0.5),
                                  motion({0, 0, 6}, {0, 0, 0}, {0, 0, 0}, {0, 0, -10}), options(1.2));
  EXPECT_EQ(r.status, Status::contact);
  EXPECT_LE(r.toc, 1.0)
      << "s: later would be too late. Is the speed that of the time of the look, and for the time that is left?";
  EXPECT_NEAR(r.toc, 1.0, 1e-6) << "s";
}

TEST(Ex09Advance, RandomFlightsAreNeverLate) {
  std::mt19937_64 random(10);
  std::normal_distribution<double> gauss;
  const auto vec = [&] { return Vec3(gauss(random), gauss(random), gauss(random)); };
  int hits = 0;
  for (int round = 0; round < 120; ++round) {
    std::vector<Vec3> points_a, points_b;
    for (int i = 0; i < 12; ++i) points_a.push_back(0.5 * vec()), points_b.push_back(0.5 * vec());
    const ca::ConvexCore core_a(points_a), core_b(points_b);
    const double radius = round % 4 == 0 ? 0.1 : 0;
    const ca::Convex a = core_a.convex(radius), b = core_b.convex(radius);
    const Vec3 apart = 5 * vec().normalized();
    const ca::Motion ma = motion({0, 0, 0}, vec(), 3 * vec(), round % 3 == 0 ? vec() : Vec3(Vec3::Zero()));
    const ca::Motion mb = motion(apart, ma.velocity - 4 * apart.normalized() + vec(), 3 * vec());
    const ca::AdvanceOptions o = options(1.5);
    const ca::AdvanceResult mine = ask(a, ma, b, mb, o), fast = ca::advance(a, ma, b, mb, o);
    if (fast.status == Status::touching_at_start || fast.status == Status::penetrating_at_start) continue;
    ASSERT_EQ(mine.status, fast.status)
        << "flight " << round << ", where the fast version says " << ca::name_of(fast.status);
    EXPECT_EQ(clear::check_certificate(mine.certificate, a, ma, b, mb, mine.toc), "") << "flight " << round;
    if (mine.status != Status::contact) continue;
    ++hits;
    const double there = ca::distance(a, b, ca::PairPose(ma, mb, mine.toc), {1e-12, 0, 128}).upper;
    EXPECT_LE(there, 1e-6) << "m: at toc they are this far apart: a contact that is too early";
    if (HasFailure()) return;
  }
  EXPECT_GT(hits, 20) << "flights that hit: the test is about them";
}

TEST(Ex09Advance, RefusesWhatItCannotProve) {
  const ca::ConvexCore core = ball();
  EXPECT_THROW(ask(core.convex(1), motion({0, 0, 0}), core.convex(1), motion({5, 0, 0}), options(-1)),
               std::invalid_argument)
      << "an interval of -1 s";
}

}  // namespace

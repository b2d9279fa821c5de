// Exercise 1.10. What an advancement wrote is proved; what a liar wrote is not.
#include "ex10_certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ch01_convex_advancement/advance.hpp"
#include "common/rigid_body.hpp"

namespace {

using fc::Vec3;
namespace ca = fc::ca;
using ca::CertificateRow;
using fc::mine::check_certificate;
using Rows = std::vector<CertificateRow>;

ca::Motion motion(const Vec3& position, const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero(),
                  const Vec3& acceleration = Vec3::Zero()) {
  fc::RigidBody body;
  body.position = position;
  body.velocity = velocity;
  body.spin = spin;
  return ca::Motion(body, acceleration);
}

ca::ConvexCore box(const Vec3& size) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(0.5 * size.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return ca::ConvexCore(corners);
}

// The chapter's scene: a brick that spins flies at a cube.
struct SpinningBox {
  ca::ConvexCore cube = box(Vec3::Ones()), brick = box({1.2, 0.4, 0.3});
  ca::Motion stands = motion({0, 0, 0}), flies = motion({3, 0.2, 0.1}, {-1.5, 0, 0}, {1, 2, 3});
  ca::AdvanceResult answer;

  explicit SpinningBox(ca::MotionBound bound = ca::MotionBound::directional) {
    ca::AdvanceOptions options;
    options.interval = 2;
    options.bound = bound;
    options.certificate = true;
    answer = ca::advance(cube.convex(0), stands, brick.convex(0), flies, options);
  }
  std::string check(const Rows& rows, double toc) const {
    return check_certificate(rows, cube.convex(0), stands, brick.convex(0), flies, toc);
  }
  std::string check(const Rows& rows) const { return check(rows, answer.toc); }
};

TEST(Ex10Certificate, ProvesWhatTheAdvancementWrote) {
  for (const ca::MotionBound bound :
       {ca::MotionBound::naive, ca::MotionBound::directional, ca::MotionBound::second_order}) {
    const SpinningBox scene(bound);
    EXPECT_EQ(scene.check(scene.answer.certificate), "") << "by which bound a row was made does not matter";
  }
}

TEST(Ex10Certificate, ProvesRandomFlights) {
  std::mt19937_64 random(10);
  std::normal_distribution<double> gauss;
  const auto vec = [&] { return Vec3(gauss(random), gauss(random), gauss(random)); };
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 10; ++i) points.push_back(0.5 * vec());
    const ca::ConvexCore a(points), b = box({1, 0.5, 0.3});
    const ca::Motion ma = motion({0, 0, 0}, vec(), 4 * vec(), round % 2 ? vec() : Vec3(Vec3::Zero()));
    const ca::Motion mb = motion(5 * vec().normalized(), 2 * vec(), 4 * vec());
    ca::AdvanceOptions options;
    options.certificate = true;
    const ca::AdvanceResult r = ca::advance(a.convex(0), ma, b.convex(0.1), mb, options);
    ASSERT_EQ(check_certificate(r.certificate, a.convex(0), ma, b.convex(0.1), mb, r.toc), "")
        << "flight " << round;
  }
}

TEST(Ex10Certificate, ProvesWhatStandsAndWhatParts) {
  const ca::ConvexCore cube = box(Vec3::Ones());
  const double gap = 2 - 1e-9;  // from x = 0.5 to x = 2.5
  for (const double speed : {0.0, 1.0}) {
    const ca::Motion stands = motion({0, 0, 0}), goes = motion({3, 0, 0}, {speed, 0, 0});
    EXPECT_EQ(check_certificate({{0, Vec3::UnitX(), gap, 0, 100}}, cube.convex(0), stands, cube.convex(0),
                                goes, 100),
              "")
        << "B goes away with " << speed << " m/s and nothing spins: the gap of 2 m is never used up";
  }
}

TEST(Ex10Certificate, RefusesANanometreTooMuch) {
  const SpinningBox scene;
  Rows rows = scene.answer.certificate;
  rows[3].gap_lower += 1e-9;  // what the row's plane was found to leave is less
  const std::string said = scene.check(rows);
  ASSERT_NE(said, "") << "row 3 claims a nanometre more than there is";
  EXPECT_EQ(said.substr(0, 6), "row 3:") << "say which row: " << said;
}

TEST(Ex10Certificate, RefusesADroppedRow) {
  const SpinningBox scene;
  for (std::size_t k = 0; k < scene.answer.certificate.size(); ++k) {
    Rows rows = scene.answer.certificate;
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_NE(scene.check(rows), "") << "row " << k << " is missing: nobody has proved that time clear";
  }
}

TEST(Ex10Certificate, RefusesToEndBeforeContact) {
  const SpinningBox scene;
  EXPECT_NE(scene.check(scene.answer.certificate, scene.answer.toc + 0.01), "")
      << "s: the last 10 ms are not proved";
  EXPECT_NE(scene.check({}, 0.5), "") << "no rows prove nothing";
  EXPECT_EQ(scene.check({}, 0), "") << "and of no time nothing has to be proved";
}

TEST(Ex10Certificate, RefusesANormalThatTellsAnotherGap) {
  const SpinningBox scene;
  Rows rows = scene.answer.certificate;
  rows[5].normal = Vec3::UnitZ();
  EXPECT_NE(scene.check(rows), "") << "along z there is no such gap";
  rows = scene.answer.certificate;
  rows[5].normal *= 1.5;
  EXPECT_NE(scene.check(rows), "") << "a longer normal makes a longer gap of the same bodies";
  rows = scene.answer.certificate;
  rows[0].normal = Vec3::UnitX();
  EXPECT_EQ(scene.check(rows), "")
      << "along x the gap is larger than row 0 says: the row promises less than is true";
}

TEST(Ex10Certificate, RefusesASpeedThatIsTooSmall) {
  const SpinningBox scene;
  Rows rows = scene.answer.certificate;
  rows[0].speed_bound = 0.5;
  EXPECT_NE(scene.check(rows), "") << "the brick comes with 1.5 m/s: the row's line soon lies above the gap";
}

TEST(Ex10Certificate, RefusesAGapThatDoesNotLast) {
  const SpinningBox scene;
  Rows rows = scene.answer.certificate;
  const double end = rows.back().t + rows.back().advance;
  rows.back().advance += 1e-3;
  EXPECT_NE(scene.check(rows, end + 1e-3), "") << "the gap is used up before the row's end";
}

TEST(Ex10Certificate, LooksBetweenTheEnds) {
  // A bar turns by half a turn before a wall: at both ends it lies along the wall, and in between it goes through.
  const ca::ConvexCore bar({{0, -1, 0}, {0, 1, 0}}), wall = box({1, 4, 4});
  const ca::Motion turns = motion({0, 0, 0}, {0, 0, 0}, {0, 0, std::acos(-1.0)}), stands = motion({1, 0, 0});
  const double gap = 0.5 - 1e-9;
  EXPECT_NE(
      check_certificate({{0, Vec3::UnitX(), gap, 0, 1}}, bar.convex(0), turns, wall.convex(0), stands, 1), "")
      << "0.5 m of gap at 0 s and at 1 s, and at 0.5 s the bar is half a metre deep in the wall";
  EXPECT_EQ(check_certificate({{0, Vec3::UnitX(), gap, 3.2, 0.15}}, bar.convex(0), turns, wall.convex(0),
                              stands, 0.15),
            "")
      << "for 0.15 s it is true";
}

TEST(Ex10Certificate, NoNumberProvesNothing) {
  const SpinningBox scene;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int cell = 0; cell < 5; ++cell) {
    Rows rows = scene.answer.certificate;
    CertificateRow& row = rows[2];
    (cell == 0   ? row.t
     : cell == 1 ? row.normal.x()
     : cell == 2 ? row.gap_lower
     : cell == 3 ? row.speed_bound
                 : row.advance) = nan;
    EXPECT_NE(scene.check(rows), "")
        << "cell " << cell << " is NaN: every comparison with it is false, so ask for what must be true";
  }
}

}  // namespace

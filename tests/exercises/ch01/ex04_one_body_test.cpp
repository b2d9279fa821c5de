// Exercise 1.4. The tests look at all pairs of points, which a support mapping never has to.
#include "ex04_one_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using fc::Mat3;
using fc::Vec3;
using fc::exercises::difference_support;
using fc::exercises::gap_on_the_way;
using fc::exercises::Rounded;
using fc::exercises::support;
using fc::exercises::swept_support;

struct Any {
  std::mt19937_64 random{4};
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> u{0, 1};

  Vec3 vec() { return {gauss(random), gauss(random), gauss(random)}; }
  Rounded body() {
    Rounded b;
    for (int i = 0; i < 6; ++i) b.points.push_back(vec());
    b.radius = 0.3 * u(random);
    b.rotation = Eigen::AngleAxisd(3 * u(random), vec().normalized()).toRotationMatrix();
    b.position = 3 * vec();
    return b;
  }
};

Vec3 world(const Rounded& b, const Vec3& p) {
  return b.rotation * p + b.position;
}

// max d.(y - x) over all pairs of points, with both balls; d is a unit vector.
double farthest(const Rounded& a, const Rounded& b, const Vec3& d) {
  double most = -1e300;
  for (const Vec3& p : a.points)
    for (const Vec3& q : b.points) most = std::max(most, d.dot(world(b, q) - world(a, p)));
  return most + a.radius + b.radius;
}

TEST(Ex04OneBody, SupportOfATurnedBoxThatFlewAway) {
  Rounded box;
  for (int i = 0; i < 8; ++i) box.points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 2 : -2, i & 4 ? 3 : -3);
  box.rotation = Eigen::AngleAxisd(std::acos(-1.0) / 2, Vec3::UnitZ()).toRotationMatrix();  // x to y, y to -x
  box.position = {10, 0, 0};
  EXPECT_NEAR((support(box, Vec3(1, 0.1, 0.1)) - Vec3(12, 1, 3)).norm(), 0, 1e-12)
      << "m, from (12, 1, 3), the corner of the turned box farthest along (1, 0.1, 0.1)";
}

TEST(Ex04OneBody, TheBallCountsOnceAndInAnyLength) {
  Rounded ball{{Vec3::Zero()}, 0.5, Mat3::Identity(), Vec3(1, 2, 3)};
  for (const double length : {1e-320, 1e-200, 1e-6, 1.0, 1e6, 1e200, 1e308})
    EXPECT_NEAR((support(ball, Vec3(0, length, 0)) - Vec3(1, 2.5, 3)).norm(), 0, 1e-9)
        << "m: a ball of 0.5 m reaches 0.5 m along a direction of length " << length;
}

TEST(Ex04OneBody, DifferenceIsFarthestOfAllPairs) {
  Any any;
  for (int i = 0; i < 200; ++i) {
    const Rounded a = any.body(), b = any.body();
    const Vec3 d = any.vec().normalized();
    EXPECT_NEAR(d.dot(difference_support(a, b, d)), farthest(a, b, d), 1e-9)
        << "m along d: the largest d.(b - a) of any point b of B and any point a of A";
  }
}

TEST(Ex04OneBody, DifferenceIsAPointOfTheDifference) {
  // Boxes have corners: the support of the difference must be a difference of corners, not just as far.
  Rounded a, b;
  for (int i = 0; i < 8; ++i) {
    a.points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    b.points.emplace_back(i & 1 ? 2 : -2, i & 2 ? 3 : -3, i & 4 ? 4 : -4);
  }
  b.position = {10, 20, 30};
  EXPECT_NEAR((difference_support(a, b, Vec3(1, -2, 3)) - Vec3(13, 16, 35)).norm(), 0, 1e-12)
      << "m, from (10 + 2 + 1, 20 - 3 - 1, 30 + 4 + 1): a corner of B less the corner of A on the other side";
}

TEST(Ex04OneBody, TwoBallsAreOneBall) {
  const Rounded a{{Vec3::Zero()}, 1, Mat3::Identity(), Vec3(1, 0, 0)};
  const Rounded b{{Vec3::Zero()}, 2, Mat3::Identity(), Vec3(5, 0, 0)};
  EXPECT_NEAR((difference_support(a, b, Vec3::UnitX()) - Vec3(7, 0, 0)).norm(), 0, 1e-12)
      << "m, from (7, 0, 0): the difference of two balls is a ball of the sum of their radii, at the difference of their "
         "centres";
  EXPECT_NEAR((difference_support(a, b, -Vec3::UnitX()) - Vec3(1, 0, 0)).norm(), 0, 1e-12)
      << "m, from (1, 0, 0): of that ball about (4, 0, 0) with a radius of 3 m the point farthest along -x";
}

TEST(Ex04OneBody, SweptIsFarthestOfTheWholeFlight) {
  Any any;
  for (int i = 0; i < 200; ++i) {
    const Rounded a = any.body();
    Rounded b = any.body();
    const Vec3 d = any.vec().normalized(), travel = 4 * any.vec(), start = b.position;
    const double swept = d.dot(swept_support(a, b, travel, d));
    double most = -1e300;
    for (int k = 0; k <= 10; ++k) {
      b.position = start + 0.1 * k * travel;
      most = std::max(most, farthest(a, b, d));
    }
    EXPECT_NEAR(swept, most, 1e-9) << "m along d: the farthest of all that is swept over";
  }
}

TEST(Ex04OneBody, TheGapOnTheWayIsTheSmallest) {
  Any any;
  for (int i = 0; i < 200; ++i) {
    const Rounded a = any.body();
    Rounded b = any.body();
    const Vec3 n = any.vec().normalized(), travel = 4 * any.vec(), start = b.position;
    const double gap = gap_on_the_way(a, b, travel, n);
    double least = 1e300;
    for (int k = 0; k <= 10; ++k) {
      b.position = start + 0.1 * k * travel;
      least = std::min(least, -farthest(a, b, -n));
    }
    EXPECT_NEAR(gap, least, 1e-9) << "m: the smallest n.(b - a) during the flight";
  }
}

TEST(Ex04OneBody, ABallThatFliesPastAWall) {
  Rounded wall;
  for (int i = 0; i < 8; ++i) wall.points.emplace_back(i & 1 ? 0.1 : 0, i & 2 ? 5 : -5, i & 4 ? 5 : -5);
  const Rounded ball{{Vec3::Zero()}, 0.5, Mat3::Identity(), Vec3(3, 0, 0)};
  EXPECT_NEAR(gap_on_the_way(wall, ball, {0, 100, 0}, Vec3::UnitX()), 2.4, 1e-12)
      << "m: it flies along the wall and keeps its distance, 3 - 0.5 - 0.1";
  EXPECT_NEAR(gap_on_the_way(wall, ball, {-2, 0, 0}, Vec3::UnitX()), 0.4, 1e-12)
      << "m: the gap is smallest at the end, 2 m nearer";
  EXPECT_NEAR(gap_on_the_way(wall, ball, {2, 0, 0}, Vec3::UnitX()), 2.4, 1e-12)
      << "m: it flies away, so the gap is smallest at the start";
  EXPECT_NEAR(gap_on_the_way(wall, ball, {-10, 0, 0}, Vec3::UnitX()), -7.6, 1e-12)
      << "m: it flies through; at the end it is 7.6 m beyond where it would touch";
}

// In long double, also 1e6 m from the origin, with gaps that are next to nothing.
TEST(Ex04OneBody, AGapIsNoneThatRoundingMade) {
  using Long = long double;
  using Long3 = Eigen::Matrix<Long, 3, 1>;
  Any any;
  for (int i = 0; i < 2000; ++i) {
    Rounded a = any.body(), b = any.body();
    const double far = i % 2 == 0 ? 0 : 1e6;
    const Vec3 shift = far * any.vec(), n = any.vec().normalized(),
               travel = i % 3 == 0 ? Vec3(-0.3 * n) : any.vec();
    a.position += shift;
    b.position += shift;
    b.position -= gap_on_the_way(a, b, travel, n) * n;  // as near to contact as doubles allow
    const Long3 long_n = n.cast<Long>();
    const auto place = [&](const Rounded& body, const Vec3& p) {
      return long_n.dot(body.rotation.cast<Long>() * p.cast<Long>() + body.position.cast<Long>());
    };
    Long truth = 1e300L, size = travel.norm();
    for (const Vec3& p : a.points)
      for (const Vec3& q : b.points) truth = std::min(truth, place(b, q) - place(a, p));
    truth += std::min(Long(0), long_n.dot(travel.cast<Long>())) - (Long(a.radius) + b.radius) * long_n.norm();
    size += a.position.norm() + b.position.norm() + 20;
    const Long excess = gap_on_the_way(a, b, travel, n) - truth;
    ASSERT_LE(excess, 0)
        << "m: by so much the gap is larger than the exact one, " << truth
        << " m. If it is > 0 the two are said never to meet: take off what rounding may have added";
    ASSERT_GE(excess, -1e-12L * size) << "m: so much smaller than the exact one rounding does not ask for";
  }
}

}  // namespace

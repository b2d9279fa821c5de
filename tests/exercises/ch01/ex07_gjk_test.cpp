// Exercise 1.7. The distances of boxes and balls are known; of random hulls the two bounds are, each by what it means.
#include "ex07_gjk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using fc::Mat3;
using fc::Pose;
using fc::Vec3;
using fc::mine::Gap;
namespace ca = fc::ca;
namespace clear = fc::ca::clear;

Gap gap_of(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& pose, double accuracy = 1e-9) {
  return fc::mine::gap(a, b, pose, accuracy, clear::closest_point);
}

ca::ConvexCore box(const Vec3& size) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(0.5 * size.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return ca::ConvexCore(corners);
}

Mat3 turned(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

ca::PairPose pose(const Vec3& a, const Vec3& b, const Mat3& turn_a = Mat3::Identity(),
                  const Mat3& turn_b = Mat3::Identity()) {
  return ca::PairPose(Pose{turn_a, a}, Pose{turn_b, b});
}

struct Any {
  std::mt19937_64 random;
  std::normal_distribution<double> gauss;
  explicit Any(int seed) : random(static_cast<unsigned>(seed)) {}
  Vec3 vec() { return {gauss(random), gauss(random), gauss(random)}; }
  double up_to(double most) { return std::uniform_real_distribution<double>(0, most)(random); }
  ca::ConvexCore hull(int points) {
    std::vector<Vec3> all;
    for (int i = 0; i < points; ++i) all.push_back(vec());
    return ca::ConvexCore(all);
  }
  Mat3 turn() { return turned(vec(), up_to(3)); }
};

TEST(Ex07Gjk, FaceBeforeFace) {
  const ca::ConvexCore cube = box(Vec3::Ones()), brick = box({1.2, 0.4, 0.3});
  const Gap g = gap_of(cube.convex(0), brick.convex(0), pose({0, 0, 0}, {3, 0.2, 0.1}));
  EXPECT_NEAR(g.upper, 1.9, 1e-12)
      << "m: the cube ends at x = 0.5, the brick begins at 2.4. A little more: the loop ended too soon, with `lower` at "
      << g.lower << " m. 3.1: that is the brick's far side";
  EXPECT_NEAR(g.lower, 1.9, 1e-8) << "m: the plane between the two faces";
  EXPECT_NEAR((g.normal - Vec3::UnitX()).norm(), 0, 1e-7) << "from A to B, that is +x";
}

TEST(Ex07Gjk, CornerBeforeCorner) {
  const ca::ConvexCore cube = box(Vec3::Ones());
  const Gap g = gap_of(cube.convex(0), cube.convex(0), pose({10, 20, 30}, {12, 22, 32}));
  EXPECT_NEAR(g.upper, std::sqrt(3.0), 1e-12) << "m: two corners, 1 m apart in x, y and z";
  EXPECT_NEAR((g.point_a - Vec3(0.5, 0.5, 0.5)).norm(), 0, 1e-12)
      << "m, from A's corner; seen from A's centre of mass";
  EXPECT_NEAR((g.point_b - Vec3(1.5, 1.5, 1.5)).norm(), 0, 1e-12)
      << "m, from B's corner; seen from A's centre of mass";
  EXPECT_EQ(g.corners, 1) << "corners of the simplex: a single difference of two corners";
}

TEST(Ex07Gjk, TurnedBodies) {
  // A cube that stands on its edge reaches sqrt(1/2) along x.
  const ca::ConvexCore cube = box(Vec3::Ones());
  const Gap g = gap_of(cube.convex(0), cube.convex(0),
                       pose({0, 0, 0}, {0, 2, 0}, turned(Vec3::UnitZ(), std::acos(-1.0) / 4)));
  EXPECT_NEAR(g.upper, 1.5 - std::sqrt(0.5), 1e-12)
      << "m: turn the direction into each body's axes, and its answer back";
}

TEST(Ex07Gjk, BallsTakeTheirRadii) {
  const std::vector<Vec3> middle{Vec3::Zero()}, ends{{0, 0, -1}, {0, 0, 1}};
  const ca::ConvexCore ball(middle), rod(ends);
  const Gap two = gap_of(ball.convex(0.5), ball.convex(0.25), pose({0, 0, 0}, {3, 4, 0}));
  EXPECT_NEAR(two.upper, 4.25, 1e-13) << "m: centres 5 m apart, less 0.5 m and 0.25 m";
  EXPECT_NEAR(two.lower, 4.25, 1e-8) << "m: the lower bound loses both radii, too";
  EXPECT_NEAR((two.point_a - Vec3(0.3, 0.4, 0)).norm(), 0, 1e-12) << "m, from A's surface towards B";
  const Gap capsule = gap_of(ball.convex(0.5), rod.convex(0.1), pose({0, 0, 0}, {2, 0, 0.3}));
  EXPECT_NEAR(capsule.upper, 1.4, 1e-12) << "m: from the ball to the rod's side";
}

TEST(Ex07Gjk, TheLowerBoundIsOne) {
  // Stopped early, it must be a support gap, not the length of x.
  Any any(3);
  for (int i = 0; i < 400; ++i) {
    const ca::ConvexCore a = any.hull(20), b = any.hull(20);
    const ca::PairPose at = pose(any.vec(), any.vec() + Vec3(4 + any.up_to(4), 0, 0), any.turn(), any.turn());
    const Gap g = gap_of(a.convex(0.1), b.convex(0.2), at, 0.5);
    const double truth = ca::distance(a.convex(0.1), b.convex(0.2), at, {1e-12, 0, 128}).upper;
    ASSERT_LE(g.lower, truth)
        << "m: the true distance is smaller than what you call certified: an advance would step through";
    const double along = ca::support_gap(a.convex(0.1), b.convex(0.2), at, g.normal);
    ASSERT_LE(g.lower, along + 1e-14)
        << "m: the gap along your normal is less than `lower`, by " << g.lower - along
        << " m. Much: `normal` is of another iteration. Some 1e-14: rounding_term()";
    ASSERT_GE(g.upper, truth - 1e-12) << "m: no two points are nearer than the distance";
    ASSERT_NEAR(g.normal.norm(), 1, 1e-14) << "the normal's length";
  }
}

// The book's closest point, which remembers the directions that GJK went through.
std::vector<Vec3> directions;
clear::ClosestPoint remembered(std::span<const Vec3> simplex) {
  const clear::ClosestPoint p = clear::closest_point(simplex);
  if (p.point.norm() > 1e-3) directions.push_back(p.point.normalized());
  return p;
}

TEST(Ex07Gjk, TheBestBoundCounts) {
  Any any(7);
  for (int i = 0; i < 400; ++i) {
    const ca::ConvexCore a = any.hull(20), b = any.hull(20);
    const ca::PairPose at = pose(any.vec(), any.vec() + Vec3(5 + any.up_to(4), 0, 0), any.turn(), any.turn());
    directions.clear();
    const Gap g = fc::mine::gap(a.convex(0), b.convex(0), at, 0.3, remembered);
    if (g.upper < 1e-3) continue;
    ASSERT_FALSE(directions.empty()) << "directions: the closest point was not asked of the argument";
    for (std::size_t k = 0; k < directions.size(); ++k)
      ASSERT_GE(g.lower, ca::support_gap(a.convex(0), b.convex(0), at, directions[k]) - 1e-9)
          << "m: in iteration " << k << " of " << directions.size()
          << " a larger gap was met. Lower bounds go up and down: keep the best, with its normal";
  }
}

TEST(Ex07Gjk, TheBoundsMeet) {
  Any any(4);
  for (int i = 0; i < 600; ++i) {
    const ca::ConvexCore a = any.hull(8 + i % 20), b = any.hull(3 + i % 9);
    const ca::PairPose at = pose(any.vec(), any.vec() + any.up_to(8) * any.vec(), any.turn(), any.turn());
    const ca::Convex sa = a.convex(0), sb = b.convex(0);
    const ca::GjkResult truth = ca::distance(sa, sb, at, {1e-12, 0, 128});
    const Gap g = gap_of(sa, sb, at);
    if (truth.status == ca::GjkResult::Status::separated && truth.lower > 1e-6) {
      ASSERT_NEAR(g.upper, truth.upper, 2e-9) << "m, upper bound: the distance";
      ASSERT_LE(g.upper - g.lower, 1.01e-9) << "m, between the bounds: asked for 1e-9";
      ASSERT_NEAR((g.point_b - g.point_a).norm(), g.upper, 1e-12) << "m, between the witness points";
    } else if (truth.status == ca::GjkResult::Status::overlapping && truth.upper == 0) {
      ASSERT_LE(g.lower, 1e-12) << "m: the bodies overlap, no gap can be certified";
    }
  }
}

TEST(Ex07Gjk, ANanometreApartTheBoundsStillMeet) {
  Any any(8);
  const ca::ConvexCore a = box({1, 0.8, 0.6}), b = box({1.2, 0.4, 0.3});
  for (int i = 0; i < 200; ++i) {
    const Mat3 turn_a = any.turn(), turn_b = any.turn();
    const Vec3 far = 3 * any.vec().normalized();
    const ca::GjkResult there =
        ca::distance(a.convex(0), b.convex(0), pose({0, 0, 0}, far, turn_a, turn_b), {1e-13, 0, 128});
    const double apart = i % 2 == 0 ? 1e-7 : 1e-9;
    const ca::PairPose at =
        pose({0, 0, 0}, far - (there.upper - apart) * there.normal, turn_a, turn_b);  // B comes along n
    const Gap g = gap_of(a.convex(0), b.convex(0), at, 1e-13);
    ASSERT_NEAR(g.upper, apart, 1e-12) << "m: the witness points";
    ASSERT_GE(g.lower, apart - 1e-11)
        << "m: the plane of your normal leaves " << g.lower << " m of a gap of " << apart << " m, with "
        << g.corners
        << " corners. x is short here, a difference of coordinates of 1 m: x/|x| has lost digits. What direction of the "
           "simplex has not?";
  }
}

TEST(Ex07Gjk, OverlapHasNoPlane) {
  const ca::ConvexCore cube = box(Vec3::Ones());
  const Gap g = gap_of(cube.convex(0), cube.convex(0), pose({0, 0, 0}, {0.3, 0.2, 0.1}));
  EXPECT_EQ(g.upper, 0) << "m";
  EXPECT_LE(g.lower, 0) << "m";
  EXPECT_EQ(g.corners, 0) << "corners: there are no witness points";
}

TEST(Ex07Gjk, EndsWhateverTheAccuracy) {
  // Nothing is exact to 0: the loop ends because no point lies farther.
  Any any(5);
  for (int i = 0; i < 100; ++i) {
    const ca::ConvexCore a = any.hull(30), b = any.hull(30);
    const Gap g =
        gap_of(a.convex(0), b.convex(0), pose({0, 0, 0}, {9, any.up_to(1), 0}, any.turn(), any.turn()), 0);
    ASSERT_LE(g.upper - g.lower, 1e-12) << "m, between the bounds";
  }
}

TEST(Ex07Gjk, NamesTheCornersThatMadeIt) {
  Any any(6);
  for (int i = 0; i < 100; ++i) {
    const ca::ConvexCore a = any.hull(12), b = any.hull(12);
    const ca::PairPose at = pose({0, 0, 0}, {8, any.up_to(2), 0}, any.turn(), any.turn());
    const Gap g = gap_of(a.convex(0), b.convex(0), at);
    ASSERT_GE(g.corners, 1);
    ASSERT_LE(g.corners, 3) << "corners: disjoint bodies need at most a face";
    double least = 1e300;
    for (int k = 0; k < g.corners; ++k) {
      const Vec3 corner =
          at.offset_world + at.rotation_b * g.from_b[k].point - at.rotation_a * g.from_a[k].point;
      least = std::min(least, g.normal.dot(corner));
    }
    ASSERT_NEAR(least, g.upper, 1e-7)
        << "m along n: the simplex that is reported does not lie at the distance";
  }
}

}  // namespace

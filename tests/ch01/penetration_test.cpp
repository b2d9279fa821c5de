// Depth of overlap against closed forms, and against the hull of all differences of two hulls' corners.
#include "ch01_convex_advancement/penetration.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::test;

Pose at(const Vec3& position, const Quat& orientation = Quat::Identity()) {
  return {orientation.toRotationMatrix(), position};
}

ca::Penetration penetration_of(const Solid& a, const Pose& in_world_a, const Solid& b,
                               const Pose& in_world_b) {
  return ca::penetration(a.convex(), b.convex(), ca::PairPose(in_world_a, in_world_b));
}

void expect_depth(const ca::Penetration& p, double depth, const Vec3& direction) {
  EXPECT_NEAR(p.depth, depth, 1e-4 * std::abs(depth) + 1e-14) << "m";
  EXPECT_LT((p.direction - direction).norm(), 2e-3) << p.direction.transpose();
  EXPECT_LE(p.lower, p.depth);
}

TEST(Penetration, OfCubes) {
  const Solid cube = box(Vec3::Ones());
  for (const double depth : {1e-6, 1e-3, 0.1, 0.3})
    expect_depth(penetration_of(cube, at({0, 0, 0}), cube, at({0.05, 0.1, 1 - depth})), depth, Vec3::UnitZ());
  // A wall of the same size as the floor's hole is nearer sideways.
  expect_depth(penetration_of(box({4, 4, 1}), at({0, 0, 0}), cube, at({-2.4, 0, 0.3})), 0.1, -Vec3::UnitX());
  // Edge to edge: both turned by 45 degrees, about x and about y; the shortest way is straight up.
  const Quat about_x(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX()));
  const Quat about_y(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()));
  expect_depth(penetration_of(cube, at({0, 0, 0}, about_x), cube, at({0, 0, std::sqrt(2.0) - 0.02}, about_y)),
               0.02, Vec3::UnitZ());
}

TEST(Penetration, OfBallsAndCapsules) {
  const Solid ball = sphere(0.5);
  expect_depth(penetration_of(ball, at({0, 0, 0}), ball, at({0.9, 0, 0})), 0.1, Vec3::UnitX());
  EXPECT_NEAR(penetration_of(ball, at({1, 2, 3}), ball, at({1, 2, 3})).depth, 1, 1e-12);  // any direction
  expect_depth(penetration_of(box(Vec3::Ones()), at({0, 0, 0}), ball, at({0, 0, 0.99})), 0.01, Vec3::UnitZ());
  // Its centre is inside of the box, too.
  expect_depth(penetration_of(box(Vec3::Ones()), at({0, 0, 0}), ball, at({0, 0, 0.3})), 0.7, Vec3::UnitZ());
  // Axes that cross, 0.15 apart, and in one point: across both.
  const Solid rod = capsule(0.1, 2);
  const Quat level(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
  expect_depth(penetration_of(rod, at({0, 0, 0}), rod, at({0, 0.15, 0}, level)), 0.05, Vec3::UnitY());
  EXPECT_NEAR(penetration_of(rod, at({0, 0, 0}), rod, at({0, 0, 0}, level)).depth, 0.2, 1e-12);
  EXPECT_NEAR(penetration_of(rod, at({0, 0, 0}), rod, at({0, 0, 0.5})).depth, 0.2, 1e-12);  // sideways
  // It lies on the box, 2 mm deep.
  expect_depth(penetration_of(box({4, 4, 1}), at({0, 0, 0}), rod, at({0, 0, 0.598}, level)), 2e-3,
               Vec3::UnitZ());
}

TEST(Penetration, OfCylindersAndCones) {
  const ca::ConvexCore cylinder({{0, 0, -0.5}, {0, 0, 0.5}}, {0.5, 0.5});
  const ca::ConvexCore cone({{0, 0, -0.5}, {0, 0, 0.5}}, {0.5, 0});
  const auto of = [](const ca::ConvexCore& a, const ca::ConvexCore& b, const Vec3& place) {
    return ca::penetration(a.convex(0), b.convex(0), ca::PairPose(at({0, 0, 0}), at(place)));
  };
  expect_depth(of(cylinder, cylinder, {0.6, 0.8 - 1e-3 / 0.8, 0}), 1 - std::hypot(0.6, 0.8 - 1e-3 / 0.8),
               Vec3(0.6, 0.8 - 1e-3 / 0.8, 0).normalized());
  expect_depth(of(cylinder, cylinder, {0.3, 0.2, 0.99}), 0.01, Vec3::UnitZ());
  EXPECT_NEAR(of(cylinder, cylinder, {0, 0, 0}).depth, 1, 1e-2) << "every way is as short";
  expect_depth(of(cylinder, cone, {0, 0.3, 0.98}), 0.02, Vec3::UnitZ());
  // Base down, side by side: two slopes 2 : 1 that face away; the rims meet below.
  expect_depth(of(cone, cone, {0.97, 0, 0}), 0.03 * 2 / std::sqrt(5.0), Vec3(2, 0, 1) / std::sqrt(5.0));
}

TEST(Penetration, OfShapesApartIsTheirDistance) {
  expect_depth(penetration_of(sphere(0.5), at({0, 0, 0}), sphere(0.5), at({0, 2, 0})), -1, Vec3::UnitY());
}

// The smallest distance of the origin from the facets of the hull of all differences a - b.
double depth_by_all_differences(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b) {
  std::vector<Vec3> differences;
  for (const Vec3& p : a.core.vertices)
    for (const Vec3& q : b.core.vertices) differences.push_back(pose_a * p - pose_b * q);
  const TriangleMesh hull = hull_mesh(differences).value();
  double depth = std::numeric_limits<double>::infinity();
  for (const auto& t : hull.triangles) {
    const Vec3 normal =
        (hull.vertices[t[1]] - hull.vertices[t[0]]).cross(hull.vertices[t[2]] - hull.vertices[t[0]]);
    if (normal.norm() > 1e-10) depth = std::min(depth, normal.normalized().dot(hull.vertices[t[0]]));
  }
  return depth;
}

TEST(Penetration, OfRandomHulls) {
  Random random(7);
  int overlapping = 0;
  for (int k = 0; k < 120; ++k) {
    const bool plate = k % 5 == 0;
    const Solid a =
        plate ? box({1, 0.7, magnitude(random, 1e-3, 1e-1)}) : random_hull(random, 1, integer(random, 5, 40));
    const Solid b = random_hull(random, magnitude(random, 0.05, 1), integer(random, 5, 40));
    // Pushed together along a line until they overlap by something between a micrometre and all of it.
    const Vec3 line = unit_vector(random);
    const Pose pose_a = at(unit_vector(random), rotation(random));
    Pose pose_b = at(pose_a.position, rotation(random));
    const double all = penetration_of(a, pose_a, b, pose_b).depth;
    if (!(all > 1e-3)) continue;  // a hull need not hold its origin
    ++overlapping;
    double apart = 0, together = 4;
    for (const double wanted = all * magnitude(random, 1e-6, 0.9); together - apart > 1e-12;) {
      const double middle = 0.5 * (apart + together);
      pose_b.position = pose_a.position + middle * line;
      (depth_by_all_differences(a, pose_a, b, pose_b) < wanted ? together : apart) = middle;
    }
    const double truth = depth_by_all_differences(a, pose_a, b, pose_b);
    const ca::Penetration found = penetration_of(a, pose_a, b, pose_b);
    EXPECT_NEAR(found.depth, truth, 1e-4 * truth + 1e-12) << "case " << k;
    EXPECT_LE(found.lower, truth + 1e-12) << "case " << k;
    EXPECT_NEAR(found.direction.norm(), 1, 1e-12);
    // Moved apart as it says, they touch and no more.
    pose_b.position += found.depth * found.direction;
    EXPECT_LT(std::abs(depth_by_all_differences(a, pose_a, b, pose_b)), 1e-4 * truth + 1e-12) << "case " << k;
  }
  EXPECT_GT(overlapping, 100);
}

TEST(Penetration, NeverExceedsWhatAnyDirectionNeeds) {
  Random random(8);
  for (int k = 0; k < 200; ++k) {
    const Solid a = random_solid(random, 1), b = random_solid(random, 1);
    const Pose pose_a = at({0, 0, 0}, rotation(random));
    const Pose pose_b = at(0.3 * a.reach() * unit_vector(random), rotation(random));
    const ca::Penetration found = penetration_of(a, pose_a, b, pose_b);
    const auto needs = [&](const Vec3& n) {
      return -ca::support_gap(a.convex(), b.convex(), ca::PairPose(pose_a, pose_b), n);
    };
    EXPECT_NEAR(needs(found.direction), found.depth, 1e-13 + 1e-9 * std::abs(found.depth)) << "case " << k;
    for (int i = 0; i < 2000; ++i)
      EXPECT_GE(needs(unit_vector(random)), found.depth * (1 - 1e-3) - 1e-12)
          << "case " << k << a.name << b.name;
  }
}

}  // namespace

// Support mappings: the table's answer is that of looking at every point; disks in closed form.
#include <gtest/gtest.h>

#include "ch01_convex_advancement/convex.hpp"
#include "tests/support/random_engine.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::test;

double height(const ca::Convex& core, const Vec3& d) {
  return ca::support(core, d).point.dot(d);
}
double truth(const std::vector<Vec3>& points, const Vec3& d) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) most = std::max(most, p.dot(d));
  return most;
}
// Directions where a table could go wrong: any; along axes, in the planes between the cube's sides, on the
// borders of cells; normal to an edge or a face, where points tie.
Vec3 awkward_direction(Random& random, const std::vector<Vec3>& points) {
  switch (integer(random, 0, 4)) {
    case 0:
      return magnitude(random, 1e-6, 1e6) * unit_vector(random);
    case 1:
      return Vec3(integer(random, -1, 1), integer(random, -1, 1), integer(random, 0, 1) * 2 - 1);
    case 2:
      return Vec3(1, integer(random, -64, 64) / 64.0, integer(random, -64, 64) / 64.0);
    case 3: {
      const auto any = [&] { return points[integer(random, 0, static_cast<int>(points.size()) - 1)]; };
      const Vec3 a = any(), n = (any() - a).cross(any() - a);
      return n.squaredNorm() > 0 ? n : Vec3(Vec3::UnitX());
    }
    default:
      return Vec3(1, 1 + 1e-15 * integer(random, -4, 4), uniform(random, -1, 1));
  }
}

RC_GTEST_PROP(SupportTable, AnswersAsIfItLookedAtEveryPoint, ()) {
  Random random = random_engine();
  const double size = magnitude(random, 1e-3, 1e6);
  std::vector<Vec3> points;
  const int n = integer(random, 1, 300), kind = integer(random, 0, 4);
  for (int i = 0; i < n; ++i) {
    Vec3 p = unit_vector(random);
    if (kind == 1) p *= uniform(random, 0, 1);                                     // points inside
    if (kind == 2) p = p.cwiseProduct(Vec3(1, magnitude(random, 1e-9, 1), 1e-9));  // a flat needle
    if (kind == 3)
      p = Vec3(integer(random, -3, 3), integer(random, -3, 3), integer(random, -3, 3));  // a lattice
    points.push_back(size * p +
                     (kind == 4 ? size * Vec3(10, -7, 3) : Vec3(Vec3::Zero())));  // far from the centre
  }
  const ca::SupportTable table(points);
  for (int k = 0; k < 200; ++k) {
    const Vec3 d = awkward_direction(random, points);
    const double found = points[table.support(points, d)].dot(d), best = truth(points, d);
    RC_ASSERT(found >= best - 1e-14 * ca::reach_of(points) * d.norm());
  }
}

TEST(SupportTable, LooksAtFewPoints) {
  Random random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) points.push_back(unit_vector(random));
  const ca::SupportTable table(points);
  EXPECT_LT(table.mean_listed(), 8);  // of 2,000
}

TEST(Support, OfCylinderAndCone) {
  const ca::ConvexCore cylinder({{0, 0, -1}, {0, 0, 1}}, {0.5, 0.5});
  const ca::Convex c = cylinder.convex(0);
  EXPECT_NEAR(height(c, {1, 0, 0}), 0.5, 1e-15);
  EXPECT_NEAR(height(c, {3, 4, 5}), 5 * 0.5 + 5, 1e-14);
  EXPECT_NEAR(height(c, {0, 0, -2}), 2, 1e-15);
  EXPECT_NEAR(c.reach, std::hypot(0.5, 1.0), 1e-14);
  EXPECT_NEAR(ca::reach_across(c, Vec3::UnitZ()), 0.5, 1e-14);
  EXPECT_GE(ca::reach_across(c, Vec3::UnitX()), std::hypot(0.5, 1.0));
  const ca::ConvexCore cone({{0, 0, -0.5}, {0, 0, 1.5}}, {1, 0});
  const ca::Convex k = cone.convex(0);
  EXPECT_NEAR(height(k, {1, 0, 0}), 1, 1e-15);
  EXPECT_NEAR(height(k, {0, 0, 1}), 1.5, 1e-15);
  EXPECT_NEAR(height(k, {2, 0, 1}), 1.5, 1e-14);  // perpendicular to the slope: apex and rim tie
  EXPECT_EQ(ca::support(k, {0, 0, 1}).index, 1);
  EXPECT_NEAR(k.reach, 1.5, 1e-14);
}

// Distances of round shapes in closed form.
TEST(Support, DistancesOfCylinderAndCone) {
  const ca::ConvexCore cylinder({{0, 0, -1}, {0, 0, 1}}, {0.5, 0.5}),
      cone({{0, 0, -0.5}, {0, 0, 1.5}}, {1, 0});
  const ca::ConvexCore point({Vec3::Zero()});
  const auto gap = [&](const ca::ConvexCore& a, const ca::ConvexCore& b, double radius,
                       const ca::Motion& mb) {
    const ca::GjkResult g = ca::distance(a.convex(0), b.convex(radius),
                                         ca::PairPose(motion(Vec3::Zero()), mb, 0), {1e-13, 1e-13, 200});
    EXPECT_LE(g.lower, g.upper);
    EXPECT_LE(g.upper - g.lower, 1e-12);
    return g.upper;
  };
  EXPECT_NEAR(gap(cylinder, point, 0.25, motion({3, 0, 0})), 2.25, 1e-12);  // side
  EXPECT_NEAR(gap(cylinder, point, 0, motion({0.3, 0.1, 4})), 3, 1e-12);    // cap
  EXPECT_NEAR(gap(cylinder, point, 0, motion({3.5, 0, 5})), 5, 1e-12);      // rim: 3 and 4
  EXPECT_NEAR(gap(cylinder, cylinder, 0, motion({4, 0, 0.7})), 3, 1e-12);   // parallel
  const Quat across(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
  EXPECT_NEAR(gap(cylinder, cylinder, 0, motion({3, 0, 0}, across)), 2, 1e-12);    // crossed
  EXPECT_NEAR(gap(cylinder, cylinder, 0, motion({0, 0, 3}, across)), 1.5, 1e-12);  // lying over a cap
  EXPECT_NEAR(gap(cone, point, 0, motion({0, 0, 3})), 1.5, 1e-12);                 // apex
  EXPECT_NEAR(gap(cone, point, 0, motion({2, 0, 1.5})), 2 * 2 / std::sqrt(5.0),
              1e-12);                                                  // slope: 2x + z = 1.5
  EXPECT_NEAR(gap(cone, point, 0, motion({0.2, 0, -2})), 1.5, 1e-12);  // base
}

}  // namespace

// Exercise 1.6. A closest point proves itself: no corner lies nearer to the origin along it. So the tests need no second answer.
#include "ex06_closest_point.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "ch01_convex_advancement/simplex.hpp"

namespace {

using fc::Vec3;
using fc::mine::closest_point;
using fc::mine::ClosestPoint;
using Corners = std::vector<Vec3>;

int needed(const ClosestPoint& p) {
  int count = 0;
  for (const double w : p.weight) count += w > 0 ? 1 : 0;
  return count;
}

double size_of(const Corners& corners) {
  double size = 0;
  for (const Vec3& c : corners) size = std::max(size, c.norm());
  return size;
}

std::string written(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

std::string in(const Corners& corners) {
  std::string text = "; the simplex:";
  for (const Vec3& c : corners) text += " " + written(c);
  return text;
}

std::string yours(const ClosestPoint& p) {
  return fmt::format("; yours is {}, with the weights {:.6g}, {:.6g}, {:.6g}, {:.6g}", written(p.point),
                     p.weight[0], p.weight[1], p.weight[2], p.weight[3]);
}

// Weights >= 0 that sum to 1, and the point that they say.
void expect_a_point_of(const Corners& corners, const ClosestPoint& p) {
  double sum = 0;
  Vec3 said = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GE(p.weight[i], 0) << "the weight of corner " << i << ": the point would lie outside the simplex"
                              << in(corners);
    if (i >= corners.size()) {
      EXPECT_EQ(p.weight[i], 0) << "the weight of corner " << i << ", which is not there" << in(corners);
      continue;
    }
    sum += p.weight[i];
    said += p.weight[i] * corners[i];
  }
  EXPECT_NEAR(sum, 1, 1e-12) << "the sum of the weights" << in(corners);
  EXPECT_NEAR((said - p.point).norm(), 0, 1e-12 * size_of(corners))
      << "m, between `point` and the sum of weight[i] * corner i" << in(corners) << yours(p);
}

// No corner lies nearer to the origin along p: then no point of the hull does.
void expect_closest(const Corners& corners, double accuracy = 1e-12) {
  const ClosestPoint p = closest_point(corners);
  expect_a_point_of(corners, p);
  const double length = p.point.norm(), size = size_of(corners);
  if (length <= accuracy * size) return;  // it is the origin itself
  for (std::size_t i = 0; i < corners.size(); ++i)
    EXPECT_GE(p.point.dot(corners[i]) / length, length - accuracy * size)
        << "m: the point is " << length << " m away from the origin, but corner " << i
        << " reaches nearer along it: on the way to that corner there is a closer point" << in(corners);
}

TEST(Ex06ClosestPoint, OfOnePoint) {
  const ClosestPoint p = closest_point(Corners{{1, -2, 2}});
  EXPECT_EQ(p.weight[0], 1) << "the weight of the only corner";
  EXPECT_EQ((p.point - Vec3(1, -2, 2)).norm(), 0) << "m, from the only corner";
}

TEST(Ex06ClosestPoint, InTheMiddleOfAnEdge) {
  const ClosestPoint p = closest_point(Corners{{-1, 1, 0}, {3, 1, 0}});
  EXPECT_NEAR((p.point - Vec3(0, 1, 0)).norm(), 0, 1e-14)
      << "m, from (0, 1, 0): the foot of the perpendicular" << yours(p);
  EXPECT_NEAR(p.weight[0], 0.75, 1e-14) << "the nearer corner has the larger weight";
}

TEST(Ex06ClosestPoint, AtTheEndOfAnEdge) {
  // The foot of the perpendicular lies beyond the edge.
  const ClosestPoint p = closest_point(Corners{{2, 1, 0}, {5, 1, 0}});
  EXPECT_NEAR((p.point - Vec3(2, 1, 0)).norm(), 0, 1e-14) << "m, from the end (2, 1, 0)" << yours(p);
  EXPECT_EQ(p.weight[1], 0) << "the far end is not needed: its weight must be exactly 0, or GJK keeps it";
  const ClosestPoint q = closest_point(Corners{{5, 1, 0}, {2, 1, 0}});
  EXPECT_NEAR((q.point - Vec3(2, 1, 0)).norm(), 0, 1e-14)
      << "m, from the same end, which is corner 1 here: a weight that is 1 less the others may be negative, too"
      << yours(q);
  EXPECT_EQ(q.weight[0], 0) << "the weight of the far end, corner 0";
}

TEST(Ex06ClosestPoint, InATriangle) {
  const ClosestPoint p = closest_point(Corners{{2, -1, 3}, {-1, 2, 3}, {-1, -1, 3}});
  EXPECT_NEAR((p.point - Vec3(0, 0, 3)).norm(), 0, 1e-13) << "m, from (0, 0, 3)" << yours(p);
  EXPECT_EQ(needed(p), 3) << "corners with a weight: the point lies inside the triangle";
}

TEST(Ex06ClosestPoint, BesideATriangleTheNearestEdgeCounts) {
  // The origin projects to a place beyond two edges, and both far corners have negative weights. Setting these to 0 gives the
  // third corner; but a point on an edge is nearer.
  const Corners corners{{0.3, 1, 1}, {-4, 1.2, 1}, {2, 1.5, 1}};
  expect_closest(corners);
  const Corners beyond_two{{0.5, 3, 0}, {0.5, -3, 0}, {0.6, 0, 0}};
  const ClosestPoint p = closest_point(beyond_two);
  EXPECT_NEAR((p.point - Vec3(0.5, 0, 0)).norm(), 0, 1e-13)
      << "m, from (0.5, 0, 0), the middle of the long edge" << yours(p);
  EXPECT_EQ(p.weight[2], 0) << "the weight of the corner behind that edge";
}

TEST(Ex06ClosestPoint, InsideATetrahedronNothingIsLeft) {
  const ClosestPoint p = closest_point(Corners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
  EXPECT_NEAR(p.point.norm(), 0, 1e-14) << "m: the origin is inside" << yours(p);
  EXPECT_EQ(needed(p), 4) << "corners with a weight: all four say that the bodies overlap";
}

TEST(Ex06ClosestPoint, OutsideATetrahedronAFaceCounts) {
  const ClosestPoint p = closest_point(Corners{{2, 0, 1}, {-1, 2, 1}, {-1, -2, 1}, {0, 0, 4}});
  EXPECT_NEAR((p.point - Vec3(0, 0, 1)).norm(), 0, 1e-13)
      << "m, from (0, 0, 1), on the lower face" << yours(p);
  EXPECT_EQ(p.weight[3], 0) << "the weight of the tip, which is not needed";
}

TEST(Ex06ClosestPoint, FlatAndRepeatedCornersToo) {
  // GJK meets them: faces of boxes give four corners in a plane, a capsule three on a line.
  expect_closest({{1, 1, 1}, {1, 1, 1}});
  expect_closest({{-1, 1, 0}, {1, 1, 0}, {3, 1, 0}});
  expect_closest({{-1, 1, 0}, {1, 1, 0}, {1, 1, 0}});
  expect_closest({{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}});
  expect_closest({{3, -1, 2}, {4, -1, 2}, {4, 1, 2}, {3, 1, 2}});
  expect_closest({{0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 4, 0}});
}

TEST(Ex06ClosestPoint, SmallAndLargeSimplicesAreNotFlat) {
  // Near contact the corners are micrometres apart, and less: flat or not does not depend on the size.
  for (const double size : {1e-9, 1e-6, 1.0, 1e6}) {
    const Corners corners{size * Vec3(2, -1, 3), size * Vec3(-1, 2, 3), size * Vec3(-1, -1, 3)};
    const ClosestPoint p = closest_point(corners);
    EXPECT_EQ(needed(p), 3) << "corners with a weight: the point lies inside a triangle of " << size << " m"
                            << in(corners) << yours(p);
    expect_closest(corners);
    const Corners around{size * Vec3(1, 1, 1), size * Vec3(1, -1, -1), size * Vec3(-1, 1, -1),
                         size * Vec3(-1, -1, 1)};
    EXPECT_EQ(needed(closest_point(around)), 4)
        << "corners with a weight: the origin is inside a tetrahedron of " << size << " m";
  }
}

TEST(Ex06ClosestPoint, OfThousandsOfSimplices) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss;
  for (int round = 0; round < 4000; ++round) {
    const int count = 1 + round % 4;
    const double size = std::pow(10.0, round % 7 - 3);
    const Vec3 offset =
        round % 3 == 0 ? Vec3(Vec3::Zero()) : Vec3(2 * gauss(random), gauss(random), gauss(random));
    Corners corners;
    for (int i = 0; i < count; ++i)
      corners.push_back(size * (offset + Vec3(gauss(random), gauss(random), gauss(random))));
    expect_closest(corners, 1e-11);
    if (HasFailure()) return;
  }
}

TEST(Ex06ClosestPoint, AgreesWithTheFastOne) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> gauss;
  for (int round = 0; round < 2000; ++round) {
    const int count = 1 + round % 4;
    std::array<Vec3, 4> corners;
    for (int i = 0; i < count; ++i) corners[i] = {gauss(random), gauss(random), gauss(random) + 0.5};
    const fc::ca::SimplexPoint fast = fc::ca::closest_to_origin(corners, count);
    const ClosestPoint p = closest_point(std::span(corners).first(count));
    ASSERT_NEAR((p.point - fast.point).norm(), 0, 1e-10)
        << "m, between your closest point of " << count << " corners and simplex.hpp's, which is "
        << fast.point.norm() << " m away; yours " << p.point.norm() << " m";
    ASSERT_EQ(needed(p), fast.count) << "corners with a weight";
  }
}

}  // namespace

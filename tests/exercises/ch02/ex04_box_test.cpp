// Exercise 2.4. The best box is found by trying many thousand rotations, once for each set of points.
#include "ex04_box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using fc::Mat3;
using fc::Vec3;
using fc::exercises::Box;
using fc::exercises::fit_box;
using fc::exercises::surface;
using fc::exercises::Tree;
using fc::exercises::Triangle;
using Points = std::vector<Vec3>;

struct Any {
  std::mt19937_64 random{17};
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 vector() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
  Mat3 rotation() { return Eigen::AngleAxisd(number(0, 3), vector().normalized()).toRotationMatrix(); }
};

// By how much a point is outside the box, m, in long double; and how far it is from the origin.
double outside(const Box& box, const Vec3& p) {
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  using Long33 = Eigen::Matrix<long double, 3, 3>;
  const Long33 axes = box.axes.cast<long double>();
  const Long3 s = axes.inverse() * (p.cast<long double>() - box.center.cast<long double>());
  return static_cast<double>((s.cwiseAbs() - box.half.cast<long double>()).maxCoeff());
}
Points turned(Points points, const Mat3& rotation, const Vec3& shift) {
  for (Vec3& p : points) p = rotation * p + shift;
  return points;
}
// Half sides along exact axes.
double surface_along(const Mat3& axes, const Points& points) {
  Eigen::AlignedBox3d range;
  for (const Vec3& p : points) range.extend(axes.transpose() * p);
  const Vec3 h = range.sizes() / 2;
  return 4 * (h[0] * h[1] + h[1] * h[2] + h[2] * h[0]);
}
// The smallest surface over a grid of rotations, and over a finer one about the best of them.
double best_surface(const Points& points) {
  double best = std::numeric_limits<double>::infinity();
  Mat3 center = Mat3::Identity();
  double width = std::numbers::pi / 4;
  for (int round = 0; round < 4; ++round) {
    constexpr int n = 7;
    const Mat3 about = center;
    for (int i = -n; i <= n; ++i)
      for (int j = -n; j <= n; ++j)
        for (int k = -n; k <= n; ++k) {
          const Vec3 turn = width / n * Vec3(i, j, k);
          const double angle = turn.norm();
          const Mat3 axes = angle > 0 ? Mat3(Eigen::AngleAxisd(angle, turn / angle) * about) : about;
          const double now = surface_along(axes, points);
          if (now < best) {
            best = now;
            center = axes;
          }
        }
    width /= 4;
  }
  return best;
}

Points corners(const Vec3& half) {
  Points points;
  for (int k = 0; k < 8; ++k)
    points.emplace_back(k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1], k & 4 ? half[2] : -half[2]);
  return points;
}
// A box with most of its points crowded about one long edge: they spread otherwise than the box lies.
Points crowded() {
  Points points = corners({1, 0.6, 0.15});
  Any any;
  for (int k = 0; k < 100; ++k)
    points.emplace_back(0.9 - 0.1 * any.number(0, 1), -0.6 + 1.2 * any.number(0, 1) * any.number(0, 1), 0.1);
  for (int k = 0; k < 100; ++k) points.emplace_back(1 - 0.3 * k / 100, -0.6 + 0.3 * k / 100, -0.15);
  return points;
}
Points sets(int which) {
  Any any;
  for (int k = 0; k < which; ++k) any.vector();
  Points points;
  switch (which % 5) {
    case 0:
      points = corners({1, 0.3, 0.05});
      break;
    case 1:
      points = crowded();
      break;
    case 2:
      points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
      break;  // a tetrahedron
    case 3:
      for (int k = 0; k < 12; ++k) points.push_back(any.vector().cwiseProduct(Vec3(1, 0.7, 0.2)));
      break;
    default:  // an L
      for (const Vec3& p : corners({1, 0.1, 0.1})) points.push_back(p);
      for (const Vec3& p : corners({0.1, 0.5, 0.1})) points.push_back(p + Vec3(0.9, 0.4, 0));
  }
  return turned(points, any.rotation(), any.vector());
}

TEST(Ex04Box, ContainsEveryPoint) {
  Any any;
  for (int trial = 0; trial < 60; ++trial) {
    Points points(1 + static_cast<int>(any.number(0, 20)));
    const double far = std::pow(10, any.number(-1, 3));
    const Vec3 shift = far * any.vector();
    for (Vec3& p : points) p = any.vector() + shift;
    const Box box = fit_box(points);
    for (const Vec3& p : points)
      ASSERT_LE(outside(box, p), 1e-12 * p.norm())
          << "m: a point lies outside its box, as floats have made it; what is about to touch there would be "
          << "left out as clear (the points are about " << far << " m from the origin)";
  }
}

TEST(Ex04Box, IsNoLargerThanRoundingAsks) {
  const Points points = turned(corners({1, 0.5, 0.25}), Any().rotation(), {10, -20, 30});
  const double truth = 4 * (0.5 + 0.125 + 0.25), got = surface(fit_box(points));
  EXPECT_NEAR(got, truth, 1e-3 * truth)
      << "m^2: these are the eight corners of a box of " << truth << " m^2; the box around them is that box";
}

TEST(Ex04Box, AxesAreARightHandedFrame) {
  for (int which = 0; which < 20; ++which) {
    const Mat3 axes = fit_box(sets(which)).axes.cast<double>();
    ASSERT_LE((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-6)
        << "lengths and cosines: the axes are to be unit and perpendicular";
    ASSERT_GT(axes.determinant(), 0)
        << "a mirror image is no rotation: whoever makes a quaternion of these axes, or "
        << "the third of them as a cross product, gets another box";
  }
}

TEST(Ex04Box, IsNearlyTheBest) {
  for (int which = 0; which < 10; ++which) {
    const Points points = sets(which);
    const double best = best_surface(points), got = surface(fit_box(points));
    ASSERT_LE(got, 1.1 * best) << "m^2: the best of many thousand rotations has " << best << " m^2 (set "
                               << which << "); a larger surface is hit more often, and opened for nothing";
  }
}

TEST(Ex04Box, IsNeverWorseThanAlongTheAxes) {
  Any any;
  for (int trial = 0; trial < 100; ++trial) {
    Points points = corners({any.number(0.1, 1), any.number(0.1, 1), any.number(0.1, 1)});
    for (int k = 0; k < 5; ++k) points.push_back(0.1 * any.vector());
    const double along = surface_along(Mat3::Identity(), points), got = surface(fit_box(points));
    ASSERT_LE(got, along * (1 + 1e-5)) << "m^2: the box along x, y, z is one of those to choose from";
  }
}

TEST(Ex04Box, ItDoesNotMatterWhereTheOriginIs) {
  const double truth = 4 * (0.3 + 0.05 + 0.015);
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(0.5, 1, -2), Vec3(300, 200, -400)}) {
    const double got = surface(fit_box(turned(corners({1, 0.3, 0.05}), Any().rotation(), shift)));
    EXPECT_NEAR(got, truth, 0.01 * truth) << "m^2, with the origin " << shift.norm()
                                          << " m away: how the points spread is a matter of their mean";
  }
}

TEST(Ex04Box, FlatThinAndSingle) {
  const Mat3 r = Any().rotation();
  const Points square = turned({{1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}}, r, {0, 0, 0});
  const Points line = turned({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, r, {0, 0, 0});
  const Points one = {{0.1, 0.2, 0.3}}, same = {one[0], one[0], one[0]};
  const auto check = [](const Points& points, double most, const char* what) {
    const Box box = fit_box(points);
    EXPECT_TRUE(box.center.allFinite() && box.axes.allFinite() && box.half.allFinite())
        << what << ": a number of the box is infinite or NaN; is something divided by a size of 0?";
    EXPECT_GE(box.half.minCoeff(), 0) << "m, " << what << ": a box has no negative half side";
    EXPECT_NEAR(box.axes.determinant(), 1, 1e-5) << what << ": the axes are a frame all the same";
    EXPECT_LE(surface(box), most) << "m^2, " << what << ": it needs no more, however it lies";
    for (const Vec3& p : points)
      EXPECT_LE(outside(box, p), 1e-12 * p.norm())
          << "m, " << what << ": a point is so far outside of its box";
  };
  check(square, 4.01, "a square");
  check(line, 0.01, "a line");
  check(one, 1e-6, "one point");
  check(same, 1e-6, "one point, three times");
}

// n by n squares of two triangles each, 2 m wide, in the plane z = 0; somewhere else if turned.
std::vector<Triangle> plate(int n, const Mat3& rotation, const Vec3& shift) {
  std::vector<Triangle> triangles;
  const auto at = [&](int i, int k) {
    return Vec3(rotation * Vec3(2.0 * i / n - 1, 2.0 * k / n - 1, 0) + shift);
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return triangles;
}

TEST(Ex04Box, TellsTwoPlatesApartAtOnce) {
  const Mat3 r = Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).toRotationMatrix();
  const Tree a(plate(12, r, {0, 0, 0}), fit_box), b(plate(12, r, r.col(2) * 0.05), fit_box);
  const std::int64_t pairs = node_pairs(a, b, 0.02);
  EXPECT_LE(pairs, 50)
      << "pairs of nodes: two slanted plates, 5 cm apart; with boxes along x, y, z it takes ten thousand";
}

TEST(Ex04Box, FewPairsBesideABall) {
  const Mat3 r = Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).toRotationMatrix();
  std::vector<Triangle> ball;  // of 0.5 m, 2 cm over the plate
  const auto at = [&](int i, int k) {
    const double theta = std::numbers::pi * i / 12, phi = std::numbers::pi * k / 12;
    return Vec3(0.52 * r.col(2) + 0.5 * Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                             std::cos(theta)));
  };
  for (int i = 0; i < 12; ++i)
    for (int k = 0; k < 24; ++k) {
      if (i > 0) ball.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
      if (i < 11) ball.push_back({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
    }
  const Tree a(plate(12, r, {0, 0, 0}), fit_box), b(ball, fit_box);
  const std::int64_t pairs = node_pairs(a, b, 0.01);
  EXPECT_LE(pairs, 400) << "pairs of nodes, to tell a ball from a slanted plate 2 cm below it";
}

}  // namespace

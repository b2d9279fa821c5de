// Hulls: closed forms (cube, sphere), then what every hull must be, and what flat input gives.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>
#include <set>

#include "common/convex_hull.hpp"
#include "tests/mesh/test_meshes.hpp"

namespace fc {
namespace {

std::vector<int> all_indices(std::size_t count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

double extent(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box.sizes().maxCoeff();
}

// How far points stick out of the hull's triangles. The normal of a triangle of height h turns by rounding /
// h, so that its plane is off by size / h times the rounding at the far end of the hull: measured in units of
// that factor.
double worst_outside(const TriangleMesh& hull, const std::vector<Vec3>& points) {
  double worst = 0;
  const double size = extent(points);
  for (const auto& [i, j, k] : hull.triangles) {
    const Vec3 &a = hull.vertices[i], &b = hull.vertices[j], &c = hull.vertices[k];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const Vec3 n = (b - a).cross(c - a) / longest;  // its length is the height over the longest edge
    for (const Vec3& p : points) worst = std::max(worst, n.dot(p - a) / size);
  }
  return worst;
}

// By how much a support mapping over the chosen points falls short of one over all points.
double worst_support_loss(const std::vector<Vec3>& points, const std::vector<int>& chosen,
                          std::mt19937_64& random) {
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 n = test::random_rotation(random).col(0);
    double all = -1e300, some = -1e300;
    for (const Vec3& p : points) all = std::max(all, n.dot(p - points[0]));
    for (int i : chosen) some = std::max(some, n.dot(points[i] - points[0]));
    worst = std::max(worst, all - some);
  }
  return worst;
}

TEST(ConvexHull, CubeGridKeepsTheEightCorners) {
  std::vector<Vec3> points;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      for (int k = 0; k < 5; ++k) points.emplace_back(i, j, k);
    }
  }
  EXPECT_EQ(hull_vertices(points), (std::vector<int>{0, 4, 20, 24, 100, 104, 120, 124}));
  const auto mesh = hull_mesh(points);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertices.size(), 8u);
  EXPECT_EQ(mesh->triangles.size(), 12u);
  EXPECT_TRUE(test::closed_and_oriented(*mesh));
  EXPECT_DOUBLE_EQ(signed_volume(*mesh), 64);
  EXPECT_DOUBLE_EQ(test::area(*mesh), 96);
}

TEST(ConvexHull, TetrahedronFacesOutwardWhateverTheOrder) {
  std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<int> order = all_indices(4);
  do {
    std::vector<Vec3> shuffled;
    for (int i : order) shuffled.push_back(points[i]);
    const auto mesh = hull_mesh(shuffled);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->vertices, shuffled);  // all are kept, in their order
    EXPECT_TRUE(test::closed_and_oriented(*mesh));
    EXPECT_NEAR(signed_volume(*mesh), 1.0 / 6, 1e-16);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ConvexHull, FlatSetsSpanNoVolume) {
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}};
  std::vector<Vec3> square, tilted;
  const Mat3 turn = Quat(1, 2, 3, 4).normalized().toRotationMatrix();
  for (int i = 0; i < 36; ++i) {
    square.emplace_back(i % 6, i / 6, 7);
    tilted.push_back(turn * square.back());
  }
  const std::vector<Vec3> equal(9, Vec3(1, 2, 3));
  const std::vector<Vec3> three = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const auto& points : {line, square, tilted, equal, three, std::vector<Vec3>{}}) {
    EXPECT_FALSE(hull_mesh(points));
    EXPECT_EQ(hull_vertices(points), all_indices(points.size()));
  }
}

TEST(ConvexHull, SaysNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::vector<Vec3> flat = {{0, 0, 0}, {1, 2, 3}, {2, 1, 5}, {3, 3, 8}, {1, 2, 3}};
  hull_mesh(flat);
  hull_vertices(flat);
  const std::vector<Vec3> broken = {{0, 0, 0}, {1, std::nan(""), 0}, {0, 1, 0}, {0, 0, 1}};
  hull_mesh(broken);
  EXPECT_EQ(hull_vertices(broken), all_indices(4));
  hull_mesh(test::unit_cube().vertices);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// What every hull must be. `kind` chooses how the points lie; many are hard cases of rounding.
std::vector<Vec3> random_points(int kind, int count, std::mt19937_64& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    Vec3 p = test::random_vector(random, 1);
    if (kind == 1) p.normalize();                     // on a sphere
    if (kind == 2) p = (p * 3).array().round();       // a coarse grid: coplanar, collinear, equal
    if (kind == 3) p[i % 3] = p[i % 3] < 0 ? -1 : 1;  // on the sides of a cube
    if (kind == 4) p = Vec3(p.x(), p.y(), 0.01 * p.z()).normalized();  // nearly a disc
    if (kind == 5 && i > count / 2) p = points[i / 2] + 1e-15 * p;     // nearly equal pairs
    if (kind >= 6) {                                                   // sides of a cube, blurred by rounding
      p[i % 3] = p[i % 3] < 0 ? -1 : 1;
      p += (kind == 6 ? 1e-15 : 1e-14) * test::random_vector(random, 1);
    }
    if (kind == 8)
      p = Vec3(p.x() < 0 ? -1 : 1, p.y() < 0 ? -1 : 1, p.z() < 0 ? -1 : 1) + 1e-14 * p;  // corners
    points.push_back(p);
  }
  const Mat3 turn = kind % 2 ? test::random_rotation(random) : Mat3::Identity();
  const Vec3 shift = kind == 3 ? Vec3(1000, -300, 20) : Vec3(Vec3::Zero());
  for (Vec3& p : points) p = turn * p + shift;
  return points;
}

RC_GTEST_PROP(ConvexHull, IsAClosedConvexMeshAroundAllPoints, ()) {
  auto random = test::random_engine();
  const int kind = *rc::gen::inRange(0, 9);
  const std::vector<Vec3> points = random_points(kind, *rc::gen::inRange(40, 200), random);
  const auto hull = hull_mesh(points);
  RC_ASSERT(hull.has_value());
  RC_ASSERT(test::closed_and_oriented(*hull));
  RC_ASSERT(hull->vertices.size() + hull->triangles.size() == 3 * hull->triangles.size() / 2 + 2);  // Euler
  RC_ASSERT(signed_volume(*hull) > 0);
  const double rounding = 1e-13 * (extent(points) + points[0].norm());
  RC_ASSERT(worst_outside(*hull, points) < rounding);
  // Only points of the input, in their order.
  auto at = points.begin();
  for (const Vec3& v : hull->vertices) {
    at = std::find(at, points.end(), v);
    RC_ASSERT(at != points.end());
    ++at;
  }
}

RC_GTEST_PROP(ConvexHull, VerticesAreASupportMappingOfAllPoints, ()) {
  auto random = test::random_engine();
  const std::vector<Vec3> points = random_points(*rc::gen::inRange(0, 9), *rc::gen::inRange(40, 200), random);
  const std::vector<int> chosen = hull_vertices(points);
  RC_ASSERT(std::is_sorted(chosen.begin(), chosen.end()));
  RC_ASSERT(std::set<int>(chosen.begin(), chosen.end()).size() == chosen.size());
  RC_ASSERT(worst_support_loss(points, chosen, random) <= kHullRounding * extent(points));
}

TEST(ConvexHull, TinyAndHugeHulls) {
  for (double scale : {1e-20, 1e-9, 1e9, 1e20}) {
    TriangleMesh sphere = test::sphere_mesh(scale, 8);
    const auto hull = hull_mesh(sphere.vertices);
    ASSERT_TRUE(hull);
    EXPECT_EQ(hull->vertices.size(), sphere.vertices.size());
    EXPECT_NEAR(signed_volume(*hull) / signed_volume(sphere), 1, 1e-13);
  }
}

}  // namespace
}  // namespace fc

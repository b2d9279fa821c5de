// The closest point of a simplex to the origin, against all faces by brute force.
#include "ch01_convex_advancement/simplex.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/support/random_engine.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using Points = std::array<Vec3, 4>;

// The distance of the origin from the hull of the points: the least over the faces onto whose inside it
// projects, and over the corners. A face without area adds nothing to its own faces.
Long brute_distance(const Points& p, int count) {
  Long best = std::numeric_limits<Long>::infinity();
  for (int mask = 1; mask < (1 << count); ++mask) {
    std::vector<Vec<Long>> q;
    for (int i = 0; i < count; ++i)
      if (mask & (1 << i)) q.push_back(p[i].cast<Long>());
    if (q.size() == 1) best = std::min(best, q[0].norm());
    if (q.size() == 2) best = std::min(best, point_segment<Long>(Vec<Long>::Zero(), q[0], q[1]));
    if (q.size() == 3)
      best = std::min(best, point_triangle_inside<Long>(Vec<Long>::Zero(), {q[0], q[1], q[2]}));
    if (q.size() == 4) {
      Eigen::Matrix<Long, 3, 3> m;
      m << q[0] - q[3], q[1] - q[3], q[2] - q[3];
      if (m.determinant() == 0) continue;
      const Vec<Long> w = m.fullPivLu().solve(-q[3]);
      if (w.minCoeff() > 0 && w.sum() < 1) best = 0;
    }
  }
  return best;
}

// What holds for every answer: a convex combination of the corners that it names, as near as the truth.
void check(const Points& p, int count, double slack) {
  const ca::SimplexPoint s = ca::closest_to_origin(p, count);
  double scale = 0, sum = 0;
  for (int i = 0; i < count; ++i) scale = std::max(scale, p[i].norm());
  RC_ASSERT(s.count >= 1);
  RC_ASSERT(s.count <= count);
  Vec3 combined = Vec3::Zero();
  for (int k = 0; k < s.count; ++k) {
    RC_ASSERT(s.index[k] >= 0);
    RC_ASSERT(s.index[k] < count);
    for (int m = 0; m < k; ++m) RC_ASSERT(s.index[k] != s.index[m]);
    RC_ASSERT(s.weight[k] > 0);
    sum += s.weight[k];
    combined += s.weight[k] * p[s.index[k]];
  }
  RC_ASSERT(std::abs(sum - 1) < 1e-14);
  RC_ASSERT((combined - s.point).norm() <= slack * scale);
  const double truth = static_cast<double>(brute_distance(p, count));
  RC_ASSERT(std::abs(s.point.norm() - truth) <= slack * scale);
  if (s.count == 4) RC_ASSERT(s.point == Vec3::Zero());
}

TEST(Simplex, ClosedForms) {
  const auto at = [](std::initializer_list<Vec3> points) {
    Points p;
    std::copy(points.begin(), points.end(), p.begin());
    return ca::closest_to_origin(p, static_cast<int>(points.size()));
  };
  EXPECT_EQ(at({{1, 2, 3}}).point, Vec3(1, 2, 3));
  EXPECT_EQ(at({{-1, 1, 0}, {1, 1, 0}}).point, Vec3(0, 1, 0));
  EXPECT_EQ(at({{1, 1, 0}, {3, 1, 0}}).count, 1);
  const ca::SimplexPoint face = at({{-1, -1, 2}, {2, -1, 2}, {-1, 2, 2}});
  EXPECT_EQ(face.count, 3);
  EXPECT_LT((face.point - Vec3(0, 0, 2)).norm(), 1e-15);
  EXPECT_EQ(at({{-1, -1, -1}, {3, -1, -1}, {-1, 3, -1}, {-1, -1, 3}}).count, 4);
  EXPECT_LT((at({{0, 0, 1}, {3, 0, 1}, {0, 3, 1}, {0, 0, 3}}).point - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(at({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}).point, Vec3(1, 2, 3));
  EXPECT_LT((at({{-1, 1, 0}, {1, 1, 0}, {-1, 1, 0}, {1, 1, 0}}).point - Vec3(0, 1, 0)).norm(), 1e-15);
}

// Small whole numbers: flat, repeated, collinear points and an origin exactly on faces come up all the time.
RC_GTEST_PROP(Simplex, WholeNumbers, ()) {
  Random random = random_engine();
  for (int round = 0; round < 100; ++round) {
    const int range = integer(random, 1, 4);
    Points p;
    for (Vec3& x : p)
      for (int k = 0; k < 3; ++k) x[k] = integer(random, -range, range);
    check(p, integer(random, 1, 4), 1e-14);
  }
}

RC_GTEST_PROP(Simplex, AnyPlaceAndSize, ()) {
  Random random = random_engine();
  for (int round = 0; round < 100; ++round) {
    const double size = magnitude(random, 1e-6, 1e6), far = uniform(random, 0, 3);
    const Vec3 shift = far * unit_vector(random);
    Points p;
    for (Vec3& x : p) x = size * (shift + uniform(random, 0, 1) * unit_vector(random));
    check(p, integer(random, 1, 4), 1e-12);
  }
}

// Corners that are nearly on a line, in a plane or in a point: the answer is still one of the simplex, and as
// near.
RC_GTEST_PROP(Simplex, NearlyFlat, ()) {
  Random random = random_engine();
  for (int round = 0; round < 100; ++round) {
    const Vec3 base = uniform(random, 0, 2) * unit_vector(random), u = unit_vector(random),
               v = unit_vector(random);
    const double out = magnitude(random, 1e-17, 1e-3),
                 across = integer(random, 0, 1) ? 1 : magnitude(random, 1e-17, 1);
    Points p;
    for (Vec3& x : p)
      x = base + uniform(random, -1, 1) * u + across * uniform(random, -1, 1) * v + out * unit_vector(random);
    check(p, integer(random, 2, 4), 1e-11);
  }
}

}  // namespace

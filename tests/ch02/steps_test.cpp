// Safe steps of two nodes: closed forms, and the support gap sampled in long double during the step.
#include "ch02_hull_hierarchy/steps.hpp"

#include <gtest/gtest.h>

#include "tests/support/free_bodies.hpp"
#include "tests/support/random_engine.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using namespace fc::test;
using ca::crossing_time;

TEST(CrossingTime, ClosedForms) {
  EXPECT_DOUBLE_EQ(crossing_time(2, 0, 6), 3);
  EXPECT_DOUBLE_EQ(crossing_time(0, 2, 8), 2);
  EXPECT_DOUBLE_EQ(crossing_time(1, 1, 6), 2);
  EXPECT_DOUBLE_EQ(crossing_time(-1, 1, 6), 3);  // goes away first, and comes back
  EXPECT_DOUBLE_EQ(crossing_time(5, -1, 4), 1);  // the first of the roots 1 and 4
  EXPECT_TRUE(std::isinf(crossing_time(1, -1, 1)));
  EXPECT_TRUE(std::isinf(crossing_time(-1, -1, 1)));
  EXPECT_TRUE(std::isinf(crossing_time(-1, 0, 1)));
  EXPECT_TRUE(std::isinf(crossing_time(0, 0, 1)));
  EXPECT_EQ(crossing_time(1, 0, 0), 0);
}

RC_GTEST_PROP(CrossingTime, IsTheFirstRoot, ()) {
  Random random = random_engine();
  const double c = uniform(random, -1, 1) * magnitude(random, 1e-6, 1e6);
  const double k = uniform(random, -1, 1) * magnitude(random, 1e-6, 1e6), room = magnitude(random, 1e-9, 1e3);
  const double h = crossing_time(c, k, room);
  RC_ASSERT(h > 0);
  const auto used = [&](Long t) { return Long(c) * t + Long(k) * t * t; };
  const double last = std::isinf(h) ? 1e6 : h;
  for (int i = 0; i < 50; ++i)
    RC_ASSERT(used(Long(last) * i / 50 * (1 - 1e-12L)) <= Long(room) * (1 + 1e-12L));
  if (std::isfinite(h)) {
    const Long size = Long(room) + std::abs(Long(c) * h) + std::abs(Long(k) * h * h);
    RC_ASSERT(std::abs(used(h) - Long(room)) <= 1e-14L * size);
  }
}

struct Nodes {
  Solid a, b;
  ca::Convex node_a, node_b;
  double radius_a = 0, radius_b = 0;
  ca::Motion ma, mb;

  // A node is a part of a body: its middle lies anywhere in the body, so it flies about the centre of mass.
  static ca::Convex node(Solid& s, double& radius, Random& random) {
    const Vec3 middle = uniform(random, 0, 2) * unit_vector(random);
    Vec3 center = Vec3::Zero();
    for (Vec3& x : s.core.vertices) x += middle;
    for (const Vec3& x : s.core.vertices) center += x / static_cast<double>(s.core.vertices.size());
    for (const Vec3& x : s.core.vertices) radius = std::max(radius, (x - center).norm() * (1 + 1e-15));
    return {s.core.vertices, s.radius, ca::reach_of(s.core.vertices), center};
  }
  explicit Nodes(Random& random) : a(random_solid(random, 0.5)), b(random_solid(random, 0.5)) {
    node_a = node(a, radius_a, random);
    node_b = node(b, radius_b, random);
    const auto some = [&](double size) -> Vec3 {
      if (integer(random, 0, 3) == 0) return Vec3::Zero();
      return size * magnitude(random, 1e-3, 1) * unit_vector(random);
    };
    ma = motion(some(3), rotation(random), some(3), some(10), some(10));
    mb = motion(some(3), rotation(random), some(3), some(10), some(10));
    if (integer(random, 0, 1) == 1) add_random_effects(random, ma, mb);
  }
};

RC_GTEST_PROP(Steps, TheGapKeepsItsRest, ()) {
  Random random = random_engine();
  for (int round = 0; round < 20; ++round) {
    const Nodes q(random);
    const double t = integer(random, 0, 1) * uniform(random, 0, 0.5), end = t + uniform(random, 0.1, 1);
    const double room = magnitude(random, 1e-7, 1);
    const Vec3 n = unit_vector(random);
    const ca::PairPose pose(q.ma, q.mb, t);
    const Long start = true_support_gap(q.a, q.ma, q.b, q.mb, t, n);
    const Long rounding = ca::rounding_term(q.node_a, q.node_b, pose);
    const SafeStep ball =
        ball_step(q.ma, q.node_a, q.radius_a, q.mb, q.node_b, q.radius_b, pose, n, t, end, room);
    const SafeStep plane = points_step(q.ma, q.node_a, q.mb, q.node_b, pose, n, t, end, room);
    for (const SafeStep& step : {ball, plane}) {
      RC_ASSERT(step.time > 0);
      const double h = std::min(step.time, end - t);
      RC_ASSERT(step.speed * h <= room * (1 + 1e-12));
      for (int k = 1; k <= 20; ++k) {
        const Long gap = true_support_gap(q.a, q.ma, q.b, q.mb, Long(t) + Long(h) * k / 20, n);
        RC_ASSERT(gap >= start - Long(room) - rounding);
      }
    }
  }
}

TEST(Steps, TranslationIsExact) {
  const Solid cube = box({1, 1, 1});
  const ca::Convex node = cube.convex();
  const auto steps = [&](const Vec3& va, const Vec3& vb, const Vec3& pull_b, double end) {
    const ca::Motion a = motion({0, 0, 0}, Quat::Identity(), va);
    const ca::Motion b = motion({2, 0, 0}, Quat::Identity(), vb, Vec3::Zero(), pull_b);
    const ca::PairPose pose(a, b, 0);
    return std::array{ball_step(a, node, 1, b, node, 1, pose, Vec3::UnitX(), 0, end, 0.9),
                      points_step(a, node, b, node, pose, Vec3::UnitX(), 0, end, 0.9)};
  };
  for (const SafeStep& s : steps({1, 2, 0}, {-2, 0, 5}, {0, 0, 0}, 10)) {
    EXPECT_NEAR(s.time, 0.3, 1e-12);
    EXPECT_NEAR(s.speed, 3, 1e-11);
  }
  for (const SafeStep& s : steps({1, 0, 0}, {1.5, 0, 0}, {0, 1, 0}, 10))
    EXPECT_TRUE(std::isinf(s.time));                                                             // parting
  for (const SafeStep& s : steps({0, 1, 0}, {0, 0, 1}, {0, 0, 0}, 10)) EXPECT_GT(s.time, 1e10);  // sliding
  for (const SafeStep& s : steps({0, 0, 0}, {0, 0, 0}, {-5, 0, 0}, 10))
    EXPECT_NEAR(s.time, 0.6, 1e-12);                                     // falling
  for (const SafeStep& s : steps({0, 0, 0}, {2, 0, 0}, {-5, 0, 0}, 10))  // thrown up: 2 h - 2.5 h^2 = -0.9
    EXPECT_NEAR(s.time, (2 + std::sqrt(4 + 9)) / 5, 1e-12);
}

// A vertex that leaves a face while the body's middle still comes nearer: the points' step sees it, the balls
// do not.
TEST(Steps, ThePointsStepLetsAContactPart) {
  const Solid cube = box({1, 1, 1});
  const ca::Convex node = cube.convex();
  const Quat tilt(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
  const ca::Motion a = motion({0, 0, -0.5});
  const ca::Motion b = motion({0, 0, 1}, tilt, {0, 0, -0.1}, {0, -2, 0});
  const ca::PairPose pose(a, b, 0);
  const double room = 1e-6;
  const SafeStep ball = ball_step(a, node, 0.9, b, node, 0.9, pose, Vec3::UnitZ(), 0, 1, room);
  const SafeStep plane = points_step(a, node, b, node, pose, Vec3::UnitZ(), 0, 1, room);
  EXPECT_LT(ball.time, 1e-5);
  EXPECT_GT(plane.time, 1e-7);
}

}  // namespace

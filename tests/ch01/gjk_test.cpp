// GJK against closed forms and against all pairs of features; its lower bound is always a true one.
#include "ch01_convex_advancement/gjk.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_engine.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using namespace fc::test;

ca::PairPose pose_of(const ca::Motion& a, const ca::Motion& b) {
  return ca::PairPose(a, b, 0);
}

ca::GjkResult distance_of(const Solid& a, const ca::Motion& ma, const Solid& b, const ca::Motion& mb) {
  return ca::distance(a.convex(), b.convex(), pose_of(ma, mb), {1e-15, 1e-12, 128});
}

// The certified bounds enclose the truth, the plane is one of that gap, and the witness points are on the
// shapes.
void check(const Solid& a, const ca::Motion& ma, const Solid& b, const ca::Motion& mb,
           const ca::GjkOptions& options, bool converged = true) {
  const ca::PairPose pose = pose_of(ma, mb);
  const ca::GjkResult g = ca::distance(a.convex(), b.convex(), pose, options);
  const Long truth = gap_at(a, ma, b, mb, 0);
  const double rounding = ca::rounding_term(a.convex(), b.convex(), pose);
  RC_ASSERT(std::abs(g.normal.norm() - 1) < 1e-14);
  RC_ASSERT(g.lower <= std::max(truth, Long(0)));
  const bool overlapping =
      g.status == ca::GjkResult::Status::overlapping;  // or closer than rounding can tell
  RC_ASSERT(g.upper >= truth - (overlapping ? 4 : 1) * rounding);
  if (std::isfinite(g.lower)) RC_ASSERT(g.lower <= true_support_gap(a, ma, b, mb, 0, g.normal));
  if (overlapping) {
    RC_ASSERT(g.lower <= 0);
    return;
  }
  if (!converged) return;  // the witness points may still lie inside the cores
  RC_ASSERT(g.status == ca::GjkResult::Status::separated);
  const double slack = std::max(options.absolute, options.relative * g.upper);
  RC_ASSERT(g.upper - g.lower <= 2 * slack + 8 * rounding);
  RC_ASSERT(std::abs((g.point_b - g.point_a).norm() - g.upper) <= 8 * rounding);
  const Soup<Long> core_a = placed(a.core, long_pose(ma, 0, ma.position));
  const Soup<Long> core_b = placed(b.core, long_pose(mb, 0, ma.position));
  const auto off = [&](const Vec3& p, const Soup<Long>& core, double radius) {
    const Soup<Long> point{{p.cast<Long>(), p.cast<Long>(), p.cast<Long>()}};
    return std::abs(soup_distance(point, core) - Long(radius));
  };
  RC_ASSERT(off(g.point_a, core_a, a.radius) <= 8 * rounding);
  RC_ASSERT(off(g.point_b, core_b, b.radius) <= 8 * rounding);
}

TEST(Gjk, ClosedForms) {
  const Solid ball = sphere(0.5), cube = box(Vec3::Ones());
  const auto at = [](double x, double y, double z) { return motion({x, y, z}); };
  EXPECT_NEAR(distance_of(ball, at(0, 0, 0), ball, at(3, 4, 0)).upper, 4, 1e-14);
  EXPECT_NEAR(distance_of(ball, at(0, 0, 0), cube, at(3, 0, 0)).upper, 2, 1e-14);                      // face
  EXPECT_NEAR(distance_of(ball, at(0, 0, 0), cube, at(3, 3, 0)).upper, std::sqrt(12.5) - 0.5, 1e-14);  // edge
  EXPECT_NEAR(distance_of(ball, at(0, 0, 0), cube, at(3, 3, 3)).upper, std::sqrt(18.75) - 0.5,
              1e-14);                                                                        // vertex
  EXPECT_NEAR(distance_of(cube, at(0, 0, 0), cube, at(0.3, 0.2, 1.25)).upper, 0.25, 1e-14);  // face, face
  EXPECT_NEAR(distance_of(cube, at(0, 0, 0), cube, at(0.3, 2, 2)).upper, std::sqrt(2.0),
              1e-14);                                                                           // edge, edge
  EXPECT_NEAR(distance_of(cube, at(0, 0, 0), cube, at(2, 2, 2)).upper, std::sqrt(3.0), 1e-14);  // vertices
  const Quat turned(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()));
  const ca::Motion above = motion({0, 0, 2}, turned);
  EXPECT_NEAR(distance_of(cube, at(0, 0, 0), cube, above).upper, 1.5 - std::sqrt(0.5),
              1e-14);  // face below an edge
  const Solid rod = capsule(0.1, 1);
  const Quat across(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
  EXPECT_NEAR(distance_of(rod, at(0, 0, 0), rod, at(1, 0, 0.3)).upper, 0.8, 1e-14);  // parallel
  EXPECT_NEAR(distance_of(rod, at(0, 0, 0), rod, motion({1, 0.2, 0.1}, across)).upper, 0.8,
              1e-14);                                                              // crossed
  EXPECT_NEAR(distance_of(rod, at(0, 0, 0), rod, at(0, 0, 3)).upper, 1.8, 1e-14);  // end to end
}

TEST(Gjk, NormalsPointFromAToB) {
  const Solid cube = box(Vec3::Ones());
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 n = side * Vec3::Unit(axis);
      const ca::GjkResult g = distance_of(cube, motion({0, 0, 0}), cube, motion(1.5 * n));
      EXPECT_LT((g.normal - n).norm(), 1e-15);
      EXPECT_LT(((g.point_b - g.point_a) - 0.5 * n).norm(), 1e-15);
    }
}

// Kissing boxes, rotated equally, exactly a small gap apart: bounds within rounding of it, no endless loop.
RC_GTEST_PROP(Gjk, KissingBoxes, ()) {
  Random random = random_engine();
  for (int round = 0; round < 10; ++round) {
    const double size = magnitude(random, 1e-3, 1e3), apart = size * magnitude(random, 1e-12, 1e-6);
    const Solid cube = box(size * Vec3::Ones());
    const Quat q = integer(random, 0, 1) ? Quat::Identity() : rotation(random);
    const Vec3 slide = size * Vec3(uniform(random, -0.9, 0.9), uniform(random, -0.9, 0.9), 1);
    const ca::Motion a = motion(Vec3::Zero(), q), b = motion(q * (slide + Vec3(0, 0, apart)), q);
    check(cube, a, cube, b, {1e-16 * size, 1e-12, 128});
    const ca::GjkResult g = distance_of(cube, a, cube, b);
    RC_ASSERT(std::abs(g.upper - apart) <= 1e-14 * size);
    RC_ASSERT(g.lower >= apart - 1e-13 * size);
  }
}

RC_GTEST_PROP(Gjk, RandomShapesAnywhere, ()) {
  Random random = random_engine();
  for (int round = 0; round < 10; ++round) {
    const double size = magnitude(random, 1e-3, 1e6);
    const Solid a = random_solid(random, size), b = random_solid(random, size * magnitude(random, 0.01, 100));
    const Vec3 far = integer(random, 0, 1) ? Vec3::Zero() : Vec3(1e4 * unit_vector(random));
    const double apart = uniform(random, 0, 1.5) * (a.reach() + b.reach());
    const ca::Motion ma = motion(far, rotation(random)),
                     mb = motion(far + apart * unit_vector(random), rotation(random));
    check(a, ma, b, mb, {1e-12 * size, 1e-9, 128});
    // Stopped anywhere, the bounds hold all the same.
    check(a, ma, b, mb, {0, 0, integer(random, 1, 4)}, false);
  }
}

// Moved along the normal until they nearly touch: where cancellation is worst.
RC_GTEST_PROP(Gjk, RandomShapesNearContact, ()) {
  Random random = random_engine();
  for (int round = 0; round < 10; ++round) {
    const double size = magnitude(random, 1e-3, 1e6);
    const Solid a = random_solid(random, size), b = random_solid(random, size);
    const Quat q = rotation(random), r = integer(random, 0, 3) ? rotation(random) : q;
    const ca::Motion ma = motion(Vec3::Zero(), q);
    ca::Motion mb = motion((a.reach() + b.reach()) * unit_vector(random), r);
    const ca::GjkResult g = distance_of(a, ma, b, mb);
    mb = motion(mb.position - (g.upper - size * magnitude(random, 1e-14, 1e-5)) * g.normal, r);
    check(a, ma, b, mb, {1e-16 * size, 1e-9, 128});
    check(a, ma, b, mb, {1e-9 * size, 1e-6, 128});
  }
}

// A cache from another pose, even of other indices, changes neither the bounds nor the answer.
RC_GTEST_PROP(Gjk, AnyCacheGivesTheSameDistance, ()) {
  Random random = random_engine();
  const Solid a = random_hull(random, 1, 20), b = random_hull(random, 1, 20);
  const ca::Motion ma = motion(Vec3::Zero(), rotation(random)),
                   mb = motion(2.2 * unit_vector(random), rotation(random));
  ca::SimplexCache cache;
  cache.count = integer(random, 1, 4);
  for (int k = 0; k < 4; ++k) {
    const int i = integer(random, 0, static_cast<int>(a.core.vertices.size()) - 1);
    const int j = integer(random, 0, static_cast<int>(b.core.vertices.size()) - 1);
    cache.a[k] = {a.core.vertices[i], i};
    cache.b[k] = {b.core.vertices[j], j};
  }
  const ca::GjkOptions options{1e-12, 1e-12, 128};
  const ca::GjkResult cold = ca::distance(a.convex(), b.convex(), pose_of(ma, mb), options);
  const ca::GjkResult warm = ca::distance(a.convex(), b.convex(), pose_of(ma, mb), options, &cache);
  RC_ASSERT(std::abs(cold.upper - warm.upper) <= 1e-11);
  RC_ASSERT(std::abs(cold.lower - warm.lower) <= 1e-11);
}

TEST(Gjk, SupportGapOfAGivenPlane) {
  const Solid cube = box(Vec3::Ones()), ball = sphere(0.5);
  const ca::PairPose pose = pose_of(motion({0, 0, 0}), motion({3, 4, 0}));
  EXPECT_NEAR(ca::support_gap(cube.convex(), ball.convex(), pose, Vec3::UnitX()), 2, 1e-13);
  EXPECT_NEAR(ca::support_gap(cube.convex(), ball.convex(), pose, -Vec3::UnitX()), -4, 1e-13);
  EXPECT_LE(ca::support_gap(cube.convex(), ball.convex(), pose, Vec3::UnitX()), 2);
}

// Boxes and capsules that overlap by a little: the depth along the best plane, measured.
RC_GTEST_PROP(Gjk, TouchingPlaneMeasuresShallowOverlaps, ()) {
  Random random = random_engine();
  const double tolerance = 1e-6, depth = uniform(random, 0, 2) * tolerance;
  const Solid cube = box(Vec3::Ones());
  const Quat q = rotation(random);
  const Vec3 slide(uniform(random, -0.8, 0.8), uniform(random, -0.8, 0.8), 1 - depth);
  const ca::Motion ma = motion(Vec3::Zero(), q), mb = motion(q * slide, q);
  const ca::GjkResult g =
      ca::touching_plane(cube.convex(), cube.convex(), pose_of(ma, mb), 16 * tolerance, Vec3::UnitX());
  RC_ASSERT(std::abs(g.lower + depth) <= 1e-12);
  RC_ASSERT((g.normal - q * Vec3::UnitZ()).norm() <= 1e-9);
  RC_ASSERT(g.lower <= true_support_gap(cube, ma, cube, mb, 0, g.normal));
  RC_ASSERT(std::abs(g.normal.dot(g.point_b - g.point_a) + depth) <=
            1e-12);  // on the faces, at the true pose
  RC_ASSERT(std::abs((q.conjugate() * g.point_a).z() - 0.5) <= 1e-12);
}

}  // namespace

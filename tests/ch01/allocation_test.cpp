// No query takes anything from the heap.
#include <gtest/gtest.h>

#include <set>

#include "ch01_convex_advancement/advance.hpp"
#include "ch01_convex_advancement/linear.hpp"
#include "ch04_multibody_stepping/torque_free.hpp"
#include "suite.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using fc::test::allocations;
using fc::test::Random;

TEST(Allocations, AreCounted) {
  const std::int64_t before = allocations();
  std::vector<double> some(100);
  some.resize(1000);
  EXPECT_EQ(allocations() - before, 2);
}

ca::ConvexCore core_of(const truth::Shape& shape) {
  std::vector<Vec3> points;
  for (const truth::V& p : shape.points) points.push_back(p.cast<double>());
  return ca::ConvexCore(std::move(points), {shape.disks.begin(), shape.disks.end()});
}
ca::Motion motion_of(const truth::Flight& flight) {
  RigidBody body;
  body.position = flight.position;
  body.orientation = flight.orientation;
  body.velocity = flight.velocity;
  body.spin = flight.spin;
  return ca::Motion(body, flight.acceleration);
}

// Every pair of kinds, every story, every bound; statuses of all kinds.
TEST(Allocations, NoneInAQuery) {
  ca::AdvanceResult result;
  result.features.reserve(1);
  std::set<ca::Status> seen;
  for (std::uint64_t number = 0; number < 1500; ++number) {
    suite::Query q = suite::query_of(3, number);
    q.options.certificate = false;
    q.options.bound = static_cast<ca::MotionBound>(number / 7 % 4);
    if (number % 11 == 0) q.options.max_iterations = 2;
    const ca::ConvexCore core_a = core_of(q.a.shape), core_b = core_of(q.b.shape);
    const ca::Convex a = core_a.convex(static_cast<double>(q.a.shape.radius)),
                     b = core_b.convex(static_cast<double>(q.b.shape.radius));
    const ca::Motion motion_a = motion_of(q.a.flight), motion_b = motion_of(q.b.flight);
    const std::int64_t before = allocations();
    ca::advance(a, motion_a, b, motion_b, q.options, result);
    ASSERT_EQ(allocations(), before) << "query " << number;
    seen.insert(result.status);
  }
  EXPECT_EQ(seen.size(), 5u);
}

// Large hulls have a table of directions, bodies that turn freely a series; after these are built, nothing more is
// allocated.
TEST(Allocations, NoneWithLargeHullsThatTurnFreely) {
  Random random(1);
  const auto hull = fc::test::random_hull(random, 1, 500);
  const ca::ConvexCore core(hull.core.vertices);
  const ca::Convex shape = core.convex(0.01);
  ca::AdvanceResult result;
  result.features.reserve(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 from = 4 * fc::test::unit_vector(random);
    const ca::Motion rest = fc::test::motion(Vec3::Zero(), fc::test::rotation(random));
    ca::Motion comes =
        fc::test::motion(from, fc::test::rotation(random), -2 * from, 5 * fc::test::unit_vector(random));
    world::turn_freely(comes, world::PrincipalInertia(Vec3(1, 2, 2.5).asDiagonal()));
    const std::int64_t before = allocations();
    ca::advance(shape, rest, shape, comes, {}, result);
    ASSERT_EQ(allocations(), before);
    ASSERT_EQ(result.status, ca::Status::contact);
  }
}

TEST(Allocations, NoneForStraightCorners) {
  ca::LinearQuery q;
  q.start = {Vec3(0.2, 0.2, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  q.end = q.start;
  q.end[0].z() = -1;
  ca::AdvanceResult result;
  result.features.reserve(1);
  const std::int64_t before = allocations();
  ca::advance(q, {}, result);
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(result.status, ca::Status::contact);
}

// A result object that is used again keeps nothing of its former query.
TEST(Allocations, AUsedResultIsAsGoodAsNew) {
  ca::AdvanceResult used;
  for (std::uint64_t number = 0; number < 300; ++number) {
    suite::Query q = suite::query_of(4, number);
    const ca::ConvexCore core_a = core_of(q.a.shape), core_b = core_of(q.b.shape);
    const ca::Convex a = core_a.convex(static_cast<double>(q.a.shape.radius)),
                     b = core_b.convex(static_cast<double>(q.b.shape.radius));
    const ca::Motion motion_a = motion_of(q.a.flight), motion_b = motion_of(q.b.flight);
    const ca::AdvanceResult fresh = ca::advance(a, motion_a, b, motion_b, q.options);
    ca::advance(a, motion_a, b, motion_b, q.options, used);
    EXPECT_EQ(used.status, fresh.status);
    EXPECT_EQ(used.toc, fresh.toc);
    EXPECT_EQ(used.gap_upper, fresh.gap_upper);
    EXPECT_EQ(used.iterations, fresh.iterations);
    EXPECT_EQ(used.gjk_iterations, fresh.gjk_iterations);
    EXPECT_EQ(used.features.size(), fresh.features.size());
    EXPECT_EQ(used.certificate.size(), fresh.certificate.size());
  }
}

}  // namespace

// The reference itself: against distances by brute force over features, against dense sampling, and on questions that
// it must leave undecided.
#include "support/ground_truth.hpp"

#include <gtest/gtest.h>

#include "suite.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using truth::Body;
using truth::Real;
using truth::V;
using Verdict = truth::FirstTime::Verdict;

constexpr std::uint64_t kSeed = 5;

Body ball(Real radius, const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) {
  return {{{V(0, 0, 0)}, {}, radius},
          {position, Eigen::Quaterniond::Identity(), velocity, {0, 0, 0}, {0, 0, 0}}};
}

TEST(GroundTruth, DistancesAreThoseOfBruteForce) {
  fc::test::Random random(7);
  for (int i = 0; i < 300; ++i) {
    const fc::test::Solid a = fc::test::random_solid(random, 1), b = fc::test::random_solid(random, 1);
    const fc::ca::Motion ma = fc::test::motion({0, 0, 0}),
                         mb = fc::test::motion(fc::test::uniform(random, 0.3, 2) *
                                               fc::test::unit_vector(random));
    const auto body = [](const fc::test::Solid& solid, const fc::ca::Motion& m) {
      Body result;
      for (const fc::Vec3& x : solid.core.vertices) result.shape.points.push_back(x.cast<Real>());
      result.shape.radius = solid.radius;
      result.flight.position = m.position;
      return result;
    };
    const Real exact = fc::test::gap_at<Real>(a, ma, b, mb, 0);
    const truth::Gap g = truth::gap(body(a, ma), body(b, mb), 0);
    ASSERT_GE(g.upper, exact - 1e-17L) << i << ' ' << a.name << ' ' << b.name;
    if (exact + a.radius + b.radius <= 0) continue;  // the cores overlap
    ASSERT_LE(g.lower, exact + 1e-17L) << i << ' ' << a.name << ' ' << b.name;
    ASSERT_LE(g.upper - g.lower, 1e-15L) << i << ' ' << a.name << ' ' << b.name;
  }
}

// A ball beside, above and outside the rim of a cylinder; on the slope of a cone and above its tip.
TEST(GroundTruth, DisksAreRound) {
  const Body cylinder{{{V(0, 0, -1), V(0, 0, 1)}, {0.5L, 0.5L}, 0}, {}};
  const Body cone{{{V(0, 0, -1), V(0, 0, 1)}, {1, 0}, 0}, {}};
  const auto expect_gap = [](const Body& body, const Eigen::Vector3d& at, Real expected) {
    const truth::Gap g = truth::gap(body, ball(0.25L, at, {0, 0, 0}), 0);
    EXPECT_LE(g.lower, expected + 1e-18L);
    EXPECT_GE(g.upper, expected - 1e-18L);
    EXPECT_LE(g.upper - g.lower, 1e-15L);
  };
  expect_gap(cylinder, {1.5, 2, 0.25}, 2.5L - 0.5L - 0.25L);
  expect_gap(cylinder, {0.25, 0.25, 2}, 1 - 0.25L);
  expect_gap(cylinder, {0, 3.5, 5}, 5 - 0.25L);
  expect_gap(cone, {0, 0, 2.5}, 1.5L - 0.25L);
  expect_gap(cone, {2, 0, 1}, 4 / std::sqrt(Real(5)) - 0.25L);  // the slope falls by 2 on 1
  expect_gap(cone, {0, -1.75, -2}, 1.25L - 0.25L);
}

// Never nearer than proved, at many times; and the two agree on the smallest distance.
TEST(GroundTruth, ProofsHoldAtSampledTimes) {
  int contacts = 0, misses = 0;
  for (std::uint64_t i = 0; i < 180; ++i) {
    const suite::Query q = suite::query_of(kSeed, i);
    const Real end = q.options.interval, level = q.options.tolerance;
    const truth::FirstTime first = truth::first_time(q.a, q.b, end, level, end * 1e-9L);
    const truth::Closest least = truth::closest(q.a, q.b, end, level, 300);
    ASSERT_LE(least.lower, least.upper);
    if (first.verdict == Verdict::never) {
      ASSERT_GT(least.upper, level) << i;
    }
    if (first.verdict == Verdict::at) {
      ASSERT_LE(least.lower, level) << i;
    }
    if (first.verdict == Verdict::at) {
      ASSERT_LE(truth::gap(q.a, q.b, first.upper).lower, level) << i;
    }
    for (int k = 0; k <= 40; ++k) {
      if (first.lower > 0) {
        ASSERT_GT(truth::gap(q.a, q.b, first.lower * k / 40).upper, level) << i;
      }
      ASSERT_GE(truth::gap(q.a, q.b, end * k / 40).upper, least.lower) << i;
    }
    contacts += first.verdict == Verdict::at;
    misses += first.verdict == Verdict::never;
  }
  EXPECT_GT(contacts, 50);
  EXPECT_GT(misses, 25);
}

TEST(GroundTruth, SmallestDistanceOfAFlyby) {
  const truth::Closest c =
      truth::closest(ball(0.5L, {0, 0, 0}, {0, 0, 0}), ball(0.5L, {-3, 4, 0}, {8, 0, 0}), 1, 1e-9L);
  EXPECT_LE(c.lower, 3);
  EXPECT_GE(c.upper, 3);
  EXPECT_LE(c.upper - c.lower, 1e-9L);
}

// Two balls that pass each other at distance 0 exactly: no computation with rounding can tell, and it says
// so.
TEST(GroundTruth, AnExactGrazeIsUndecided) {
  const truth::FirstTime t = truth::first_time(ball(0.5L, {0, 0, 0}, {0, 0, 0}),
                                               ball(0.5L, {-4, 1, 0}, {8, 0, 0}), 1, 0, 1e-12L, 20'000);
  EXPECT_EQ(t.verdict, Verdict::undecided);
  EXPECT_LT(t.lower, 0.5L);
  EXPECT_GT(t.lower, 0.499L);
}

}  // namespace

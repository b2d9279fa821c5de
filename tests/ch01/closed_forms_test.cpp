// First contacts whose gap over time is a known formula: a root of a quadratic, a quartic or a trigonometric
// equation. The library at tolerances from 1e-2 to 1e-12 m, and the reference to 1e-12 s.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "suite.hpp"

namespace {

using Eigen::Vector3d;
using fc::ca::Status;
using truth::Body;
using truth::Real;
using truth::V;

constexpr Real kWidth = 1e-12L;  // s, of the reference's brackets
constexpr Real kNever = std::numeric_limits<Real>::infinity();

Body ball(double radius, truth::Flight flight) {
  return {{{V(0, 0, 0)}, {}, radius}, std::move(flight)};
}
Body rod(const V& half, double radius, truth::Flight flight) {
  return {{{V(-half), half}, {}, radius}, std::move(flight)};
}
Body block(const V& half, truth::Flight flight) {
  Body body{{}, std::move(flight)};
  for (int i = 0; i < 8; ++i)
    body.shape.points.push_back(half.cwiseProduct(V((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1)));
  return body;
}
// Two disks about the z axis, the lower one first.
Body turned(Real low, Real radius_low, Real high, Real radius_high, truth::Flight flight) {
  return {{{V(0, 0, low), V(0, 0, high)}, {radius_low, radius_high}, 0}, std::move(flight)};
}
truth::Flight flight(const Vector3d& position, const Vector3d& velocity = Vector3d::Zero(),
                     const Vector3d& spin = Vector3d::Zero(),
                     const Vector3d& acceleration = Vector3d::Zero()) {
  return {position, Eigen::Quaterniond::Identity(), velocity, spin, acceleration};
}

struct Case {
  std::string name;
  Body a, b;
  double interval;                // s
  std::function<Real(Real)> gap;  // m, at t
  Real speed;                     // m/s, more than the gap ever changes with
};

// The first time at which the gap is at most `level`: from the left, never past it, to 1e-18 m.
Real first_root(const Case& c, Real level) {
  for (Real t = 0; t <= c.interval;) {
    const Real above = c.gap(t) - level;
    const Real next = t + above / c.speed;
    if (above <= 1e-18L || next == t) return t;
    t = next;
  }
  return kNever;
}

const Body floor_below = block({10, 10, 0.5L}, flight({0, 0, -0.5}));

V turned_by(const V& x, const V& axis, Real angle) {
  return x * std::cos(angle) + axis.cross(x) * std::sin(angle) + axis * axis.dot(x) * (1 - std::cos(angle));
}
Real outside(const V& x, const V& half) {  // distance of a point from a block
  return (x.cwiseAbs() - half).cwiseMax(V::Zero()).norm();
}

std::vector<Case> straight_cases() {
  std::vector<Case> all;
  all.push_back({"BallOntoAFloor", floor_below, ball(0.3125, flight({1, 2, 3}, {0.5, -0.25, -2}, {3, 2, 1})),
                 2, [](Real t) { return 3 - 2 * t - 0.3125L; }, 2.5});
  all.push_back({"BallsHeadOn", ball(0.5, flight({-2, 0, 0}, {3, 0, 0}, {4, 5, 6})),
                 ball(1, flight({2, 0, 0}, {-1, 0, 0}, {-7, 0, 8})), 1,
                 [](Real t) { return 4 - 4 * t - 1.5L; }, 5});
  const auto oblique = [&](const std::string& name, double offset) {
    all.push_back({name, ball(0.5, flight({0, 0, 0}, {1, 1, 0})),
                   ball(0.75, flight({-4, offset, 1}, {9, 1, -1})), 1,
                   [offset](Real t) { return V(-4 + 8 * t, offset, 1 - t).norm() - 1.25L; }, 10});
  };
  oblique("BallsOblique", 0.75);
  oblique("BallsGlancing", 1.1328125);
  oblique("BallsJustMissing", 1.15625);
  all.push_back({"BallsInOrbit", ball(0.25, flight({0, 0, 0}, {2, 0, 6}, {0, 0, 0}, {0, 0, -9.75})),
                 ball(0.25, flight({4, 0.125, 0}, {-1, 0, 3}, {0, 9, 0}, {0, 0, -1.5})), 2,
                 [](Real t) { return V(4 - 3 * t, 0.125L, -3 * t + 4.125L * t * t).norm() - 0.5L; }, 20});
  all.push_back({"BallThrownOntoAnEdge", block({1, 1, 0.5L}, flight({0, 0, 0})),
                 ball(0.25, flight({-4, 0.5, 0}, {2.25, 0, 7}, {5, 0, 0}, {0, 0, -9.75})), 2,
                 [](Real t) {
                   return outside({-4 + 2.25L * t, 0.5L, 7 * t - 4.875L * t * t}, {1, 1, 0.5L}) - 0.25L;
                 },
                 20});
  return all;
}

std::vector<Case> turning_cases() {
  std::vector<Case> all;
  const auto swing = [&](const std::string& name, double wall) {
    all.push_back({name, rod({0, 1, 0}, 0.0625, flight({0, 0, 0}, {0, 0, 0}, {0, 0, -3})),
                   block({0.5L, 10, 10}, flight({wall + 0.5, 0, 0})), 1,
                   [wall](Real t) { return wall - std::abs(std::sin(3 * t)) - 0.0625L; }, 4});
  };
  swing("RodSwingsIntoAWall", 0.75);
  swing("RodBarelyReachesTheWall", 1.0625 - 0x1p-20);
  swing("RodBarelyMissesTheWall", 1.0625 + 0x1p-10);
  all.push_back({"RodFallsTurning", floor_below,
                 rod({1, 0, 0}, 0.0625, flight({0, 0, 3}, {0.5, 0, -1.5}, {0, 5, 0}, {0, 0, -4})), 2,
                 [](Real t) { return 3 - 1.5L * t - 2 * t * t - std::abs(std::sin(5 * t)) - 0.0625L; }, 16});
  all.push_back({"BlockTumblesOntoAFloor", floor_below,
                 block({0.5L, 0.25L, 0.125L}, flight({1, 1, 2}, {0, 0, -0.75}, {0, 7, 0})), 3,
                 [](Real t) {
                   return 2 - 0.75L * t - 0.5L * std::abs(std::sin(7 * t)) -
                          0.125L * std::abs(std::cos(7 * t));
                 },
                 6});
  all.push_back({"RodScrewsUpToABall", rod({2, 0, 0}, 0.125, flight({0, 0, 0}, {0, 0, 1.5}, {0, 0, 4})),
                 ball(0.25, flight({0.75, 1.25, 2})), 2,
                 [](Real t) {
                   V x = turned_by({0.75L, 1.25L, 2 - 1.5L * t}, {0, 0, 1}, -4 * t);
                   x.x() = std::max(std::abs(x.x()) - 2, Real(0));
                   return x.norm() - 0.375L;
                 },
                 12});
  // Seen from the block the ball flies along a spiral.
  all.push_back({"BallInASpinningFrame", block({0.75L, 0.5L, 0.25L}, flight({0, 0, 0}, {0, 0, 0}, {3, 6, 6})),
                 ball(0.125, flight({3, 0.25, -0.5}, {-2, 0, 0.25})), 2,
                 [](Real t) {
                   const V x = turned_by({3 - 2 * t, 0.25L, -0.5L + 0.25L * t}, V(1, 2, 2) / 3, -9 * t);
                   return outside(x, {0.75L, 0.5L, 0.25L}) - 0.125L;
                 },
                 40});
  return all;
}

// The lowest point of a disk of that radius, whose axis leans by `lean` and whose centre is `along` up the
// axis.
Real rim(Real along, Real radius, Real lean) {
  return along * std::cos(lean) - radius * std::abs(std::sin(lean));
}

std::vector<Case> round_cases() {
  std::vector<Case> all;
  all.push_back(
      {"CylinderTumblesOntoAFloor", floor_below,
       turned(-0.75L, 0.25L, 0.75L, 0.25L, flight({0, 0, 2}, {0, 0, -0.5}, {0, 5, 0})), 3,
       [](Real t) { return 2 - 0.5L * t + std::min(rim(0.75L, 0.25L, 5 * t), rim(-0.75L, 0.25L, 5 * t)); },
       6});
  all.push_back(
      {"ConeTumblesOntoAFloor", floor_below,
       turned(-0.25L, 0.5L, 0.75L, 0, flight({0, 0, 2}, {0, 0, -0.5}, {4, 0, 0})), 3,
       [](Real t) { return 2 - 0.5L * t + std::min(rim(0.75L, 0, 4 * t), rim(-0.25L, 0.5L, 4 * t)); }, 6});
  return all;
}

void expect_reference(const Case& c) {
  for (const Real t : {0.0L, 0.1L, 0.25L, 0.5L}) {
    const truth::Gap g = truth::gap(c.a, c.b, t);
    const Real exact = c.gap(t);
    if (exact <= 0) continue;
    EXPECT_LE(g.lower, exact) << c.name;
    EXPECT_GE(g.upper, exact) << c.name;
    EXPECT_LE(g.upper - g.lower, 1e-14L) << c.name;
  }
  for (const Real level : {0.0L, 1e-6L}) {
    const Real root = first_root(c, level);
    const truth::FirstTime found = truth::first_time(c.a, c.b, c.interval, level, kWidth);
    if (root == kNever) {
      EXPECT_EQ(found.verdict, truth::FirstTime::Verdict::never) << c.name;
      continue;
    }
    EXPECT_EQ(found.verdict, truth::FirstTime::Verdict::at) << c.name << ' ' << found.looks << " looks";
    EXPECT_LE(found.lower, root + 1e-17L) << c.name;
    EXPECT_GE(found.upper, root - 1e-17L) << c.name;
    EXPECT_LE(found.upper - found.lower, kWidth) << c.name;
  }
}

void expect_library(const Case& c, double tolerance, fc::ca::MotionBound bound) {
  suite::Query query{c.a, c.b, {}};
  query.options.interval = c.interval;
  query.options.tolerance = tolerance;
  query.options.bound = bound;
  const fc::ca::AdvanceResult r = suite::ask(query);
  const std::string where = c.name + " to " + std::to_string(tolerance) + " m";
  EXPECT_LE(r.tolerance, std::max(tolerance, 3e-12)) << where;
  const Real touch = first_root(c, 0), near = first_root(c, r.tolerance);
  if (near == kNever) {
    EXPECT_EQ(r.status, Status::separated) << where;
  }
  if (touch != kNever) {
    EXPECT_EQ(r.status, Status::contact) << where;
  }
  EXPECT_NE(r.status, Status::unresolved) << where;
  if (r.status != Status::contact) return;
  EXPECT_LE(r.toc, touch) << where;
  EXPECT_GE(r.toc, near * (1 - 1e-15L) - r.tolerance * 1e-3L / c.speed) << where;
  const Real gap = c.gap(r.toc);
  EXPECT_GT(gap, 0) << where;
  EXPECT_LE(gap, r.tolerance * 1.001) << where;
  EXPECT_LE(r.gap_lower, gap) << where;
}

void expect_all(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    expect_reference(c);
    for (const char* bound : {"naive", "directional", "projected", "second_order"})
      for (int digits = 2; digits <= 12; ++digits)
        expect_library(c, std::pow(10.0, -digits), fc::ca::motion_bound_named(bound));
  }
}

TEST(ClosedForms, StraightAndBallisticFlights) {
  expect_all(straight_cases());
}

TEST(ClosedForms, TurningBodies) {
  expect_all(turning_cases());
  // One of the roots has a known value.
  EXPECT_NEAR(static_cast<double>(first_root(turning_cases()[0], 0)), std::asin(0.6875) / 3, 1e-15);
}

TEST(ClosedForms, BodiesWithDisks) {
  expect_all(round_cases());
}

}  // namespace

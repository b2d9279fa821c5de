// The cases on which other engines fail, each by its name; most are from their issue trackers. Besides what is expected
// here, every answer is compared with the slow reference (suite.hpp): not late, not false, both gaps right, the
// certificate replayed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ch01_convex_advancement/advance.hpp"
#include "suite.hpp"
#include "tests/support/random_engine.hpp"
#include "tests/support/random_shapes.hpp"

namespace {

using namespace fc;
using ca::AdvanceResult;
using ca::Status;
using fc::test::magnitude;
using fc::test::Random;
using fc::test::uniform;
using fc::test::unit_vector;

const Vec3 kStill = Vec3::Zero();  // an Eigen vector from {} is not zero

truth::Shape box(const Vec3& size) {
  truth::Shape s;
  for (int i = 0; i < 8; ++i)
    s.points.push_back(
        truth::V((i & 1 ? 1 : -1) * size.x(), (i & 2 ? 1 : -1) * size.y(), (i & 4 ? 1 : -1) * size.z()) / 2);
  return s;
}
truth::Shape ball(double radius) {
  return {{truth::V::Zero()}, {}, radius};
}
truth::Shape rod(double length, double radius) {  // a capsule along z
  return {{truth::V(0, 0, -length / 2), truth::V(0, 0, length / 2)}, {}, radius};
}
truth::Shape cylinder(double radius, double length) {
  return {{truth::V(0, 0, -length / 2), truth::V(0, 0, length / 2)}, {radius, radius}, 0};
}
truth::Shape cone(double radius, double length) {
  return {{truth::V(0, 0, -length / 4), truth::V(0, 0, 3 * length / 4)}, {radius, 0}, 0};
}

truth::Flight at(const Vec3& position, const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero(),
                 const Quat& orientation = Quat::Identity()) {
  truth::Flight f;
  f.position = position;
  f.velocity = velocity;
  f.spin = spin;
  f.orientation = orientation;
  return f;
}
Quat turn(double angle, const Vec3& axis) {
  return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}

// The answer, held to the reference.
AdvanceResult ask(const truth::Shape& a, const truth::Flight& fa, const truth::Shape& b,
                  const truth::Flight& fb, double tolerance = 1e-6, double interval = 1) {
  suite::Query q{{a, fa}, {b, fb}, {}};
  q.options.tolerance = tolerance;
  q.options.interval = interval;
  q.options.certificate = true;
  const suite::Verdict verdict = suite::check(q, 0);
  EXPECT_EQ(verdict.wrong, "");
  EXPECT_FALSE(verdict.undecided);
  return suite::ask(q);
}

void expect_contact(const AdvanceResult& r, double toc, double closing_speed) {
  EXPECT_EQ(r.status, Status::contact);
  EXPECT_LE(r.toc, toc * (1 + 1e-15));
  EXPECT_GE(r.toc, toc - 1.001 * r.tolerance / closing_speed);
  EXPECT_LE(r.gap_upper, r.tolerance);
  EXPECT_GT(r.gap_lower, 0);
}

// FCL #493, #495: boxes with one rotation, a hair apart.
TEST(HardCase, KissingBoxesSeparatedByEpsilon) {
  for (const Quat& q : {Quat::Identity(), turn(0.7, {1, 2, 3})})
    for (const double eps : {1e-3, 1e-6, 1e-9, 1e-12}) {
      const Vec3 up = q * Vec3::UnitZ();
      const AdvanceResult still = ask(box({1, 1, 1}), at(Vec3::Zero(), kStill, kStill, q), box({1, 1, 1}),
                                      at((1 + eps) * up, kStill, kStill, q), eps / 2);
      EXPECT_EQ(still.status, Status::separated);
      EXPECT_NEAR(still.gap_upper, eps, 2e-15);
      const AdvanceResult closing = ask(box({1, 1, 1}), at(Vec3::Zero(), kStill, kStill, q), box({1, 1, 1}),
                                        at((1 + eps) * up, -up, kStill, q), eps / 2);
      EXPECT_EQ(closing.status, Status::contact);
      EXPECT_NEAR(closing.toc, 0.75 * eps, 0.26 * eps);
    }
}

// MuJoCo, ThinBoxGrazing: 7.69e-7 m between slivers.
TEST(HardCase, ThinBoxesGrazing) {
  const Vec3 size(0.015, 2e-4, 3e-4);
  const Vec3 apart(0.003, 0, 3e-4 + 7.69e-7);
  EXPECT_EQ(ask(box(size), at(Vec3::Zero()), box(size), at(apart, {1, 0, 0}), 1e-9).status,
            Status::separated);
  expect_contact(ask(box(size), at(Vec3::Zero()), box(size), at(apart, {0.01, 0, -1e-5}), 1e-9), 7.69e-2,
                 1e-5);
}

// libccd #25: a NaN direction.
TEST(HardCase, StackedCubesTouchWithoutNaN) {
  for (const double side : {1.0, 0.1, 3.7}) {
    const AdvanceResult r = ask(box({side, side, side}), at(Vec3::Zero()), box({side, side, side}),
                                at({0, 0, side}, {0, 0, -1}), 1e-9);
    ASSERT_EQ(r.status, Status::touching_at_start);
    EXPECT_NEAR(r.features.at(0).normal.z(), 1, 1e-6);
    EXPECT_EQ(r.toc, 0);
  }
}

// coal #604: a wrong distance of two near boxes at a tolerance of 1e-6.
TEST(HardCase, NearBoxesAtAMicrometre) {
  Random random(604);
  for (int i = 0; i < 200; ++i) {
    const Quat q = fc::test::rotation(random);
    const double gap = magnitude(random, 2e-6, 1e-3);
    const AdvanceResult r = ask(
        box({0.1, 0.2, 0.3}), at(Vec3::Zero(), kStill, kStill, q), box({0.3, 0.1, 0.1}),
        at(q * Vec3(0.2 + gap, uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1)), kStill, kStill, q));
    EXPECT_EQ(r.status, Status::separated);
    EXPECT_NEAR(r.gap_upper, gap, 1e-15);
    EXPECT_NEAR(r.gap_lower, gap, 1e-6);
  }
}

// Flexible-GJK-and-EPA #8, sch-core #28: endless loops between parallel faces.
TEST(HardCase, ParallelFacesClose) {
  for (const double shift : {0.0, 0.3, 0.999999}) {
    const AdvanceResult r = ask(box({1, 1, 1}), at(Vec3::Zero()), box({1, 1, 1}),
                                at({shift, -shift / 2, 3}, {0, 0, -4}, {0, 0, 2}), 1e-9);
    EXPECT_EQ(r.status, Status::contact);
    if (shift == 0) expect_contact(r, 0.5, 4);
  }
  EXPECT_EQ(ask(box({100, 100, 1}), at(Vec3::Zero()), box({100, 100, 1}),
                at({30, 10, 1 + 1e-6}, {50, 0, 0}, {0, 0, 1}), 1e-9)
                .status,
            Status::separated);
}

// dolfinx #3653: a point and a hull some 50 sizes away.
TEST(HardCase, PointAndHullFarAway) {
  truth::Shape hull;
  Random random(3653);
  for (int i = 0; i < 60; ++i) hull.points.push_back(unit_vector(random).cast<truth::Real>());
  const truth::Shape point{{truth::V::Zero()}, {}, 0};
  for (int i = 0; i < 50; ++i) {
    const Vec3 from = 50 * unit_vector(random);
    const AdvanceResult r = ask(hull, at({40, 40, 40}), point, at(Vec3(40, 40, 40) + from, -from), 1e-9);
    EXPECT_EQ(r.status, Status::contact);
    EXPECT_LE(r.gap_upper, 1e-9);
  }
}

// openGJK #3, #56: polygons without thickness.
TEST(HardCase, FlatPolygons) {
  truth::Shape sheet;
  for (int i = 0; i < 7; ++i) sheet.points.emplace_back(std::cos(2.4L * i), std::sin(2.4L * i), 0);
  // Face to face, edge to face, edge to edge in one plane.
  expect_contact(ask(sheet, at(Vec3::Zero()), sheet, at({0.2, 0, 1}, {0, 0, -2})), 0.5, 2);
  const Quat upright = turn(std::numbers::pi / 2, Vec3::UnitX());
  EXPECT_EQ(ask(sheet, at(Vec3::Zero()), sheet, at({0, 0, 2}, {0, 0, -2}, kStill, upright)).status,
            Status::contact);
  EXPECT_EQ(ask(sheet, at(Vec3::Zero()), sheet, at({3, 0, 0}, {-2, 0, 0})).status, Status::contact);
  EXPECT_EQ(ask(sheet, at(Vec3::Zero()), sheet, at({3, 0, 1e-5}, {-4, 0, 0})).status, Status::separated);
}

// coal #37 and others: smooth shapes, where GJK has no last corner to find.
TEST(HardCase, SmoothShapesConverge) {
  Random random(37);
  const std::array<truth::Shape, 4> shapes = {cylinder(0.5, 1), cone(0.5, 1), ball(0.5), rod(1, 0.2)};
  std::int64_t most = 0;
  for (int i = 0; i < 300; ++i) {
    const auto& a = shapes[static_cast<std::size_t>(i) % 4];
    const auto& b = shapes[static_cast<std::size_t>(i) / 4 % 4];
    const Vec3 from = 3 * unit_vector(random);
    const AdvanceResult r = ask(
        a, at(Vec3::Zero(), kStill, uniform(random, 0, 5) * unit_vector(random), fc::test::rotation(random)),
        b, at(from, -1.2 * from, kStill, fc::test::rotation(random)), 1e-6);
    EXPECT_EQ(r.status, Status::contact);
    most = std::max(most, r.gjk_iterations / r.distance_calls);
  }
  EXPECT_LE(most, 20);
}

// parry #429: 139 mm of error for a target of 500 m.
TEST(HardCase, ASmallBallAndATargetOf500Metres) {
  expect_contact(ask(box({500, 500, 500}), at(Vec3::Zero()), ball(0.5), at({120, -80, 300}, {0, 0, -100})),
                 0.495, 100);
  const AdvanceResult r = ask(box({500, 500, 500}), at(Vec3::Zero(), kStill, kStill, turn(1, {1, 2, 3})),
                              ball(0.5), at({300, 300, 300}, {-300, -300, -300}));
  EXPECT_EQ(r.status, Status::contact);
}

// MuJoCo, BoxBoxLarge and LongBox: sizes 500 to 1.
TEST(HardCase, LongBoxesAndSizeRatios) {
  expect_contact(
      ask(box({50, 0.1, 0.1}), at(Vec3::Zero()), box({0.1, 0.1, 50}), at({20, 3, 0}, {0, -5.8, 0})), 0.5,
      5.8);
  const AdvanceResult r =
      ask(box({50, 0.1, 0.1}), at(Vec3::Zero(), kStill, {0, 0, 0.2}), box({0.1, 0.1, 0.1}), at({24, 2, 0}));
  EXPECT_EQ(r.status, Status::contact);
}

// Points that are hard for hull builders: inside, doubled, on faces and edges. They change nothing.
TEST(HardCase, CoincidentCoplanarAndInteriorHullPoints) {
  const truth::Shape clean = box({1, 1, 1});
  truth::Shape messy = clean;
  for (const auto& p : clean.points) {
    messy.points.push_back(p);
    messy.points.push_back(p / 2);
    messy.points.push_back({p.x(), p.y(), 0});
    messy.points.push_back({p.x(), 0, 0});
  }
  messy.points.emplace_back(0, 0, 0);
  Random random(12);
  for (int i = 0; i < 100; ++i) {
    const Vec3 from = 4 * unit_vector(random), spin = 3 * unit_vector(random);
    const truth::Flight still = at(Vec3::Zero(), kStill, spin), comes = at(from, -1.3 * from, -spin);
    const AdvanceResult r = ask(clean, still, clean, comes), s = ask(messy, still, messy, comes);
    EXPECT_EQ(r.status, s.status);
    EXPECT_NEAR(r.toc, s.toc, 1e-6);
  }
}

// Jolt, LongAndThin; godot-jolt #389: a spin alone, and a small target.
TEST(HardCase, LongThinFastSpinner) {
  const double length = 10, radius = 0.005, target = 0.02, distance = 4.9;
  for (const double angle : {0.3, 1.5, 3.0}) {
    // The rod along x turns about z; the ball waits at `angle`.
    const Quat along_x = turn(std::numbers::pi / 2, Vec3::UnitY());
    const AdvanceResult r =
        ask(rod(length, radius), at(Vec3::Zero(), kStill, {0, 0, 100}, along_x), ball(target),
            at(distance * Vec3(std::cos(angle), std::sin(angle), 0)), 1e-6, 1);
    expect_contact(r, (angle - std::asin((radius + target) / distance)) / 100, 100 * distance);
  }
}

// More than a quarter, a half, several turns within the interval, until the ball has come close enough.
TEST(HardCase, SeveralTurnsBeforeContact) {
  const Quat along_x = turn(std::numbers::pi / 2, Vec3::UnitY());
  for (const double spin : {2.0, 4.0, 20.0, 60.0}) {
    const AdvanceResult r = ask(rod(2, 0.05), at(Vec3::Zero(), kStill, {0, 0, spin}, along_x), ball(0.1),
                                at({0, 6, 0}, {0, -6, 0}), 1e-6, 1);
    EXPECT_EQ(r.status, Status::contact);
    EXPECT_GE(r.toc, (6 - 1.15) / 6 - 1e-6);  // not before the tips reach so far
    EXPECT_LE(r.toc, (6 - 0.15) / 6);         // nor after the ball is at the middle
  }
}

TEST(HardCase, ScrewMotionWithAnOffsetCentre) {
  // A thread's crest winds along z and meets a wall across it: turning about z brings nothing nearer.
  truth::Shape crest{{truth::V(1, 0, -0.2L), truth::V(1.2L, 0.1L, 0), truth::V(1, 0.3L, 0.2L)}, {}, 0.01L};
  const AdvanceResult r =
      ask(crest, at(Vec3::Zero(), {0, 0, 1}, {0, 0, 40}), box({10, 10, 1}), at({0, 0, 1.21}), 1e-9, 1);
  expect_contact(r, 0.5, 1);
  EXPECT_LE(r.iterations, 2);
}

// Box2D's figure: at the end one part overlaps, but another part hit first, on the way.
TEST(HardCase, TheEndPoseOverlapsButAnotherPartCameFirst) {
  // A rod starts upright beside a post and falls over it: its end passes through the post at a half turn.
  const AdvanceResult r = ask(rod(4, 0.05), at({0, 0, 0}, kStill, {0, 2 * std::numbers::pi, 0}),
                              box({0.2, 0.2, 0.2}), at({0.9, 0, 0.9}), 1e-9, 1);
  ASSERT_EQ(r.status, Status::contact);
  EXPECT_LT(r.toc, 0.125);  // before the rod stands at 45 degrees, where it is inside
  EXPECT_GT(r.toc, 0.09);
}

// Rapier #984, Jolt: neither body waits for the other.
TEST(HardCase, TwoFastBodiesHeadOn) {
  expect_contact(ask(ball(0.01), at({-500, 0, 0}, {1000, 0, 0}), ball(0.01), at({500, 0, 0}, {-1000, 0, 0})),
                 999.98 / 2000, 2000);
  expect_contact(ask(box({1, 1, 0.01}), at({0, 0, -300}, {0, 0, 700}), box({1, 1, 0.01}),
                     at({0.5, 0.5, 300}, {0, 0, -500})),
                 599.99 / 1200, 1200);
}

TEST(HardCase, SpinningCubeOverAPlane) {
  // On its corner, turning about the vertical: it stays above by exactly its gap.
  const Quat on_corner = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ());
  const double reach = std::sqrt(0.75);
  const auto over = [&](double gap, double fall) {
    return ask(box({50, 50, 1}), at({0, 0, -0.5}), box({1, 1, 1}),
               at({0, 0, reach + gap}, {0, 0, -fall}, {0, 0, 30}, on_corner), 1e-9, 1);
  };
  EXPECT_EQ(over(1e-6, 0).status, Status::separated);
  EXPECT_LE(over(1e-6, 0).iterations, 50);
  expect_contact(over(0.5, 1), 0.5, 1);
}

TEST(HardCase, TetrahedronCorner) {
  truth::Shape tet;
  for (const auto& p :
       {truth::V(0, 0, -1), truth::V(1, 0, 0.5L), truth::V(-0.5L, 0.8L, 0.5L), truth::V(-0.5L, -0.8L, 0.5L)})
    tet.points.push_back(p);
  const Quat upside_down = turn(std::numbers::pi, Vec3::UnitX());
  // Corner on corner, corner on face.
  expect_contact(ask(tet, at({0, 0, 4}, {0, 0, -4}), tet, at(Vec3::Zero(), kStill, kStill, upside_down)), 0.5,
                 4);
  expect_contact(ask(tet, at({0.1, 0, 3.5}, {0, 0, -4}), tet, at(Vec3::Zero())), 0.5, 4);
}

// rigid-ipc, lever-arm: the far end of a long arm that turns slowly.
TEST(HardCase, LeverArm) {
  const Quat along_x = turn(std::numbers::pi / 2, Vec3::UnitY());
  const double angle = 0.02;
  const AdvanceResult r = ask(rod(200, 0.1), at(Vec3::Zero(), kStill, {0, 0, angle}, along_x), ball(0.1),
                              at({99, 1.5, 0}), 1e-6, 1);
  const double toc = (std::atan2(1.5, 99) - std::asin(0.2 / std::hypot(99, 1.5))) / angle;
  expect_contact(r, toc, 98 * angle);
}

TEST(HardCase, ParallelEdges) {
  const Quat edge_down = turn(std::numbers::pi / 4, Vec3::UnitX()), edge_up = edge_down;
  const double half_diagonal = std::sqrt(0.5);
  expect_contact(ask(box({1, 1, 1}), at({0.3, 0, 2 * half_diagonal + 1}, {0, 0, -2}, kStill, edge_down),
                     box({1, 1, 1}), at(Vec3::Zero(), kStill, kStill, edge_up)),
                 0.5, 2);
}

// Rapier handles these, C2A and Box2D give up: a start in contact is an answer of its own, wherever it goes.
TEST(HardCase, TouchingStartAwaySlidingAndInto) {
  for (const Vec3& velocity : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 0, 0)})
    for (const double gap : {0.0, 5e-7}) {
      const AdvanceResult r =
          ask(box({2, 2, 1}), at(Vec3::Zero()), box({1, 1, 1}), at({0.2, 0, 1 + gap}, velocity));
      ASSERT_EQ(r.status, Status::touching_at_start);
      EXPECT_EQ(r.toc, 0);
      EXPECT_NEAR(r.features.at(0).normal.z(), 1, 1e-6);
    }
  EXPECT_EQ(ask(box({2, 2, 1}), at(Vec3::Zero()), box({1, 1, 1}), at({0.2, 0, 0.9}, {0, 0, 1})).status,
            Status::penetrating_at_start);
}

// ipc-toolkit, "Repeated CCD": stopped at the contact, asked again, with a smaller tolerance on and on.
TEST(HardCase, AskedAgainAfterStoppingAtContact) {
  truth::Flight comes = at({0, 0, 3}, {0.3, 0, -4}, {1, 2, 0.5});
  double left = 1, tolerance = 1e-2;
  for (int k = 0; k < 5; ++k, tolerance /= 100) {
    const AdvanceResult r = ask(box({9, 9, 1}), at(Vec3::Zero()), box({1, 1, 1}), comes, tolerance, left);
    ASSERT_EQ(r.status, Status::contact);
    ASSERT_GT(r.toc, 0);
    comes.position += r.toc * comes.velocity;
    comes.orientation = turn(r.toc * comes.spin.norm(), comes.spin) * comes.orientation;
    left -= r.toc;
  }
  const AdvanceResult again =
      ask(box({9, 9, 1}), at(Vec3::Zero()), box({1, 1, 1}), comes, 100 * tolerance, left);
  EXPECT_EQ(again.status, Status::touching_at_start);
}

TEST(HardCase, ScalesAndPlacesFarFromTheOrigin) {
  for (const double size : {1e-3, 1.0, 1e3, 1e6})
    for (const double far : {0.0, 1e4}) {
      const Vec3 origin = far * Vec3(1, -2, 0.5);
      const AdvanceResult r =
          ask(box(size * Vec3(1, 1, 1)), at(origin, kStill, {0, 0, 2}), rod(size, 0.1 * size),
              at(origin + size * Vec3(0, 0, 3), size * Vec3(0, 0, -4), {0, 0, 5}), 1e-6 * size);
      expect_contact(r, 1.9 / 4, 4 * size);
    }
}

TEST(HardCase, EverythingIsPassedInOneStep) {
  const truth::Shape wall = box({0.01, 100, 100});
  for (const double speed : {1e2, 1e4, 1e6}) {
    expect_contact(ask(wall, at(Vec3::Zero()), ball(0.05), at({-50, 0, 0}, {speed, 0, 0})), 49.945 / speed,
                   speed);
    EXPECT_EQ(ask(box({0.01, 1, 1}), at(Vec3::Zero()), ball(0.05), at({-50, 2, 0}, {speed, 0, 0})).status,
              Status::separated);
  }
}

// d / mu is longer than the interval: one advance proves it clear.
TEST(HardCase, TheStepIsSmallerThanAnyAdvance) {
  const AdvanceResult r = ask(box({1, 1, 1}), at(Vec3::Zero(), kStill, {1, 2, 3}), box({1, 1, 1}),
                              at({3, 0, 0}, {-1, 0, 0}, {3, 2, 1}), 1e-6, 1e-4);
  EXPECT_EQ(r.status, Status::separated);
  EXPECT_EQ(r.iterations, 1);
}

// A zero normal in PhysX: two bodies in one place.
TEST(HardCase, IdenticalBodiesOnTopOfEachOther) {
  for (const truth::Shape& s : {box({1, 1, 1}), ball(0.5), rod(1, 0.1), cylinder(0.5, 1), cone(0.5, 1)}) {
    const AdvanceResult r = ask(s, at({1, 2, 3}), s, at({1, 2, 3}, {1, 0, 0}));
    EXPECT_EQ(r.status, Status::penetrating_at_start);
    EXPECT_TRUE(std::isfinite(r.gap_lower));
    EXPECT_LT(r.gap_lower, -0.1);
    EXPECT_EQ(r.gap_upper, 0);
  }
}

// Bullet, OpenTissue, DigitalRune: "no hit" when the iterations are used up.
TEST(HardCase, AnIterationCapIsNotAMiss) {
  suite::Query q{
      {box({1, 0.2, 0.2}), at(Vec3::Zero(), kStill, {1, 7, 3})}, {ball(0.3), at({0, 3, 0}, {0, -3, 0})}, {}};
  q.options.certificate = true;
  q.options.bound = ca::MotionBound::naive;
  const AdvanceResult whole = suite::ask(q);
  ASSERT_EQ(whole.status, Status::contact);
  for (int most = 1; most < whole.iterations; ++most) {
    q.options.max_iterations = most;
    EXPECT_EQ(suite::check(q, 0).wrong, "");
    const AdvanceResult r = suite::ask(q);
    EXPECT_EQ(r.status, Status::unresolved);
    EXPECT_GT(r.toc, 0);
    EXPECT_LE(r.toc, whole.toc);
  }
}

}  // namespace

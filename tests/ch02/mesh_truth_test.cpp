// The reference of chapter 2's suite against closed forms, against every pair, and against dense sampling.
#include "support/mesh_truth.hpp"

#include <gtest/gtest.h>

#include "tests/support/test_models.hpp"

namespace {

using fc::Vec3;
using namespace fc::test;
using truth::Clear;
using truth::Gap;
using truth::MeshBody;
using truth::MeshShape;
using truth::Real;
using truth::V;

MeshShape shape_of(const fc::TriangleMesh& mesh, double radius = 0, bool solid = true) {
  return MeshShape(mesh.vertices, mesh.triangles, radius, solid);
}

truth::Flight flight(const Vec3& position, const Vec3& velocity = Vec3::Zero(),
                     const Vec3& spin = Vec3::Zero()) {
  truth::Flight f;
  f.position = position;
  f.velocity = velocity;
  f.spin = spin;
  return f;
}

V random_point(Random& random, double size) {
  return (size * uniform(random, 0, 1) * unit_vector(random)).cast<Real>();
}

// Triangles of every shape: large, needles, segments, points, with shared corners, parallel, in one plane.
truth::Triangle random_triangle(Random& random) {
  truth::Triangle t;
  for (V& x : t) x = random_point(random, 1);
  switch (integer(random, 0, 7)) {
    case 0:
      t[2] = t[1];
      break;
    case 1:
      t[1] = t[2] = t[0];
      break;
    case 2:
      t[2] = (t[0] + t[1]) / 2 + Real(1e-6) * random_point(random, 1);
      break;
    case 3:
      for (V& x : t) x.z() = 0;
      break;
    case 4:
      for (V& x : t) x = x.array().round();
      break;
    default:
      break;
  }
  return t;
}

TEST(MeshTruth, TrianglesAsTheOtherReferencesSay) {
  Random random(1);
  constexpr Real kNoise = 1e-17L;
  int crossing = 0;
  for (int round = 0; round < 20'000; ++round) {
    const truth::Triangle a = random_triangle(random);
    truth::Triangle b = random_triangle(random);
    if (integer(random, 0, 3)) {  // near
      const V shift = random_point(random, 2);
      for (V& x : b) x = Real(0.3) * x + shift;
    }
    const Gap g = truth::triangle_gap(a, b, kNoise);
    const Real brute = triangle_triangle<Real>({a[0], a[1], a[2]}, {b[0], b[1], b[2]});
    ASSERT_LE(g.lower, g.upper) << round;
    ASSERT_NEAR(std::max(Real(0), g.upper), brute, 1e-15) << round;
    if (brute > 1e-12L) {
      ASSERT_GE(g.lower, g.upper - 1e-15L) << round;
    }
    crossing += brute == 0;
    if (round % 20) continue;
    const auto body = [](const truth::Triangle& t) { return truth::Body{{{t[0], t[1], t[2]}, {}, 0}, {}}; };
    const Gap other = truth::gap(body(a), body(b), 0);
    ASSERT_LE(g.lower, std::max(other.upper, Real(0)) + 1e-15L) << round;
    ASSERT_GE(std::max(g.upper, Real(0)), other.lower - 1e-15L) << round;
  }
  EXPECT_GE(crossing, 500);
}

TEST(MeshTruth, GapsOfTinySize) {
  // A vertex over a face, two edges across each other, a vertex beside an edge: gaps near the rounding.
  const auto f = [](double x, double y, double z) { return V(x, y, z); };
  for (const Real gap : {1e-3L, 1e-9L, 1e-13L, 1e-16L}) {
    const truth::Triangle face{f(-1, -1, 0), f(1, -1, 0), f(0, 1, 0)};
    const V up = V(0, 0, gap);
    for (const truth::Triangle& other :
         {truth::Triangle{up, f(0.3, 0.2, 1) + up, f(-0.3, 0.1, 1) + up},
          truth::Triangle{f(-3, -1.5, 0) + up, f(3, 0.5, 0) + up, f(1, 1, 5)},
          truth::Triangle{f(0.2, -1, 0) + V(0, -gap, 0), f(1, -3, 0.5), f(1, -3, -0.5)}}) {
      const Gap g = truth::triangle_gap(face, other, 1e-19L);
      EXPECT_NEAR(g.lower / gap, 1, 1e-2);
      EXPECT_NEAR(g.upper / gap, 1, 1e-2);
      EXPECT_LE(g.lower, g.upper);
    }
  }
}

TEST(MeshTruth, BallsAgainstEveryPair) {
  Random random(2);
  int crossing = 0;
  for (int round = 0; round < 60; ++round) {
    const MeshShape a = shape_of(integer(random, 0, 1) ? bumpy_ball(random, 5) : ring(1, 0.3, 12, 6)),
                    b = integer(random, 0, 3) ? shape_of(triangle_soup(random, 40), 0, false)
                                              : shape_of(capsule(0, 1).core, 0.1);
    MeshBody body_a{&a, flight(1e3 * unit_vector(random), unit_vector(random), unit_vector(random))};
    MeshBody body_b{&b, flight(body_a.flight.position + uniform(random, 0, 3) * unit_vector(random),
                               unit_vector(random), 3 * unit_vector(random))};
    const Real t = uniform(random, 0, 1);
    const Gap fast = truth::gap(body_a, body_b, t),
              slow = truth::gap(body_a, body_b, t, truth::Search::every_pair);
    EXPECT_EQ(fast.upper, slow.upper);
    if (slow.upper > 0) {
      EXPECT_NEAR(fast.lower, slow.lower, 1e-15);
    }
    crossing += slow.upper <= 0;
  }
  EXPECT_GE(crossing, 5);
}

TEST(MeshTruth, WindsAsItShould) {
  const MeshShape cube = shape_of(cube_with_cavity()), torus = shape_of(ring(1, 0.3, 16, 8));
  EXPECT_NEAR(windings(cube, V(0.8, 0.1, 0.2)), 1, 1e-15);
  EXPECT_NEAR(windings(cube, V(0.1, 0.2, 0.3)), 0, 1e-15);
  EXPECT_NEAR(windings(cube, V(1.1, 0.2, 0.3)), 0, 1e-15);
  EXPECT_NEAR(windings(torus, V(0, 0, 0)), 0, 1e-15);
  EXPECT_NEAR(windings(torus, V(1, 0, 0)), 1, 1e-15);
  EXPECT_EQ(cube.parts.size(), 2u);
  const MeshShape ball = shape_of(sphere(0).core, 0.1);
  const auto inside = [&](const MeshShape& outer, const Vec3& at) {
    const MeshBody a{&outer, flight({5, 5, 5}, Vec3::Zero(), {0, 0, 1})},
        b{&ball, flight(Vec3(5, 5, 5) + at)};
    EXPECT_EQ(one_inside_other(a, b, 0), one_inside_other(b, a, 0));
    return one_inside_other(a, b, 0);
  };
  EXPECT_TRUE(inside(cube, {0.8, 0.1, 0.2}));
  EXPECT_FALSE(inside(cube, {0.1, 0, 0}));
  EXPECT_FALSE(inside(shape_of(cube_with_cavity(), 0, false), {0.8, 0.1, 0.2}));
}

TEST(MeshTruth, ContactsInClosedForm) {
  const MeshShape l = shape_of(l_prism()), ball = shape_of(sphere(0).core, 0.1);
  const MeshBody a{&l, flight({0, 0, 0})};
  const auto until = [&](const truth::Flight& f, Real to, Real level) {
    return truth::clear_between(a, {&ball, f}, 0, to, level).verdict;
  };
  const truth::Flight into = flight({1.5, 0.6, 0}, {-2, 0, 0});  // the crook: its face x = 0 at t = 0.7
  EXPECT_EQ(until(into, 0.7L - 1e-12L, 0), Clear::Verdict::clear);
  EXPECT_EQ(until(into, 0.7L + 1e-12L, 0), Clear::Verdict::hit);
  EXPECT_EQ(until(into, 1, 0), Clear::Verdict::hit);
  EXPECT_EQ(until(into, 0.7L - 0.5e-3L - 1e-9L, 1e-3L), Clear::Verdict::clear);
  EXPECT_EQ(until(into, 0.7L - 0.5e-3L + 1e-9L, 1e-3L), Clear::Verdict::hit);
  EXPECT_EQ(until(flight({0.5, 0.5, 2}, {0, 0, -4}), 1, 0.399L), Clear::Verdict::clear);
  // Along the face y = 0 of the crook at a gap of 1e-9, turning about its normal.
  EXPECT_EQ(until(flight({0.9, 0.1 + 1e-9, 0}, {-0.5, 0, 0}, {0, 7, 0}), 1, 0), Clear::Verdict::clear);
}

TEST(MeshTruth, IntervalsAgainstDenseSampling) {
  Random random(4);
  int clear = 0, hit = 0;
  for (int round = 0; round < 60; ++round) {
    const fc::TriangleMesh meshes[] = {bumpy_ball(random, 4), ring(1, 0.3, 8, 5), star(5, 0.2),
                                       triangle_soup(random, 12)};
    const MeshShape a = shape_of(meshes[integer(random, 0, 3)]), b = shape_of(meshes[integer(random, 0, 3)]);
    const Vec3 apart = uniform(random, 2, 4) * unit_vector(random);
    MeshBody body_a{&a, flight(unit_vector(random), unit_vector(random), 8 * unit_vector(random))};
    MeshBody body_b{
        &b, flight(body_a.flight.position + apart, body_a.flight.velocity - apart + unit_vector(random),
                   8 * unit_vector(random))};
    body_b.flight.acceleration = 2 * unit_vector(random);
    Real least = truth::kInfinity, first = 2;
    for (int k = 0; k <= 40; ++k) {
      const Real g = truth::gap(body_a, body_b, Real(k) / 40).upper;
      least = std::min(least, g);
      if (g <= 0) first = std::min(first, Real(k) / 40);
    }
    const Clear c = truth::clear_between(body_a, body_b, 0, 1, 0);
    ASSERT_NE(c.verdict, Clear::Verdict::undecided);
    if (least <= 0) {
      EXPECT_EQ(c.verdict, Clear::Verdict::hit);
    }
    if (c.verdict == Clear::Verdict::hit) {
      EXPECT_LE(truth::gap(body_a, body_b, c.time).upper, 0);
      ++hit;
    } else {
      ++clear;
      // And no more than what is true: a level above what was seen is refuted.
      EXPECT_EQ(truth::clear_between(body_a, body_b, 0, 1, least + 1e-6L).verdict, Clear::Verdict::hit);
    }
  }
  EXPECT_GE(std::min(clear, hit), 10);
}

}  // namespace

// The independent overlap check, tested: it must be able to say yes, and no.
#include <gtest/gtest.h>

#include <random>

#include "support/replay.hpp"

namespace {

using namespace independent;

constexpr double pi = 3.14159265358979323846;

State at(double x, double y, double z, Quaternion q = {}) {
  return {{x, y, z}, q, {}, {}, {}};
}

TEST(SecondOpinion, KnowsVolumesAndMoments) {
  const Solid box_solid = make_solid(box({2, 3, 4}), 10);
  EXPECT_NEAR(box_solid.mass, 240, 1e-12);
  EXPECT_NEAR(box_solid.inertia[0].x, 240 * (9 + 16) / 12.0, 1e-11);
  EXPECT_NEAR(box_solid.inertia[2].z, 240 * (4 + 9) / 12.0, 1e-11);
  EXPECT_NEAR(box_solid.inertia[0].y, 0, 1e-11);
  EXPECT_NEAR(norm(box_solid.centroid), 0, 1e-15);
  const Solid ball = make_solid(bumpy_sphere(60, 64, 0), 1);
  EXPECT_NEAR(ball.mass, 4 * pi / 3, 0.01);
  EXPECT_NEAR(ball.inertia[1].y, 8 * pi / 15, 0.01);
}

TEST(SecondOpinion, SeesCrossingTriangles) {
  const std::array<Vec, 3> flat{Vec{0, 0, 0}, Vec{1, 0, 0}, Vec{0, 1, 0}};
  EXPECT_TRUE(triangles_cross(flat, {Vec{0.2, 0.2, -1}, Vec{0.2, 0.2, 1}, Vec{5, 5, 0.5}}));
  EXPECT_TRUE(triangles_cross({Vec{0.2, 0.2, -1}, Vec{0.2, 0.2, 1}, Vec{5, 5, 0.5}}, flat));
  EXPECT_FALSE(triangles_cross(flat, {Vec{0.6, 0.6, -1}, Vec{0.6, 0.6, 1}, Vec{5, 5, 0.5}}));
  EXPECT_FALSE(triangles_cross(flat, {Vec{0.2, 0.2, 1e-9}, Vec{0.2, 0.2, 1}, Vec{5, 5, 0.5}}));
  EXPECT_TRUE(triangles_cross(flat, {Vec{0.2, 0.2, -1e-9}, Vec{0.2, 0.2, 1}, Vec{5, 5, 0.5}}));
  EXPECT_FALSE(triangles_cross(flat, {Vec{0.2, 0.2, 1e-9}, Vec{0.9, 0.2, 1e-9}, Vec{0.2, 0.9, 1e-9}}));
  EXPECT_FALSE(triangles_cross(flat, {Vec{2, 0, 0}, Vec{3, 0, 0}, Vec{2, 1, 0}}));
}

TEST(SecondOpinion, SeesBoxesOverlapByAHair) {
  const Solid unit = make_solid(box({1, 1, 1}), 1);
  const Quaternion eighth{std::cos(pi / 8), 0, 0, std::sin(pi / 8)};
  const double touch = 0.5 + std::sqrt(0.5);
  for (const How how : {How::tree, How::every_pair}) {
    EXPECT_FALSE(overlap(unit, at(0, 0, 0), unit, at(1 + 1e-9, 0.3, 0.1), how));
    EXPECT_TRUE(overlap(unit, at(0, 0, 0), unit, at(1 - 1e-9, 0.3, 0.1), how));
    EXPECT_TRUE(overlap(unit, at(0, 0, 0), unit, at(0.5, 0, 0), how)) << "faces in common planes";
    EXPECT_FALSE(overlap(unit, at(0, 0, 0), unit, at(touch + 1e-9, 0, 0.2, eighth), how));
    EXPECT_TRUE(overlap(unit, at(0, 0, 0), unit, at(touch - 1e-9, 0, 0.2, eighth), how));
    EXPECT_TRUE(overlap(unit, at(0, 0, 0), make_solid(box({0.1, 0.1, 0.1}), 1), at(0.2, 0.2, 0), how))
        << "inside";
  }
}

TEST(SecondOpinion, WindsOnceAroundWhatIsInside) {
  const Solid bumpy = make_solid(bumpy_sphere(20, 20, 0.2), 1);
  const State place = at(3, 4, 5, {0.6, 0, 0.8, 0});
  EXPECT_NEAR(winding(bumpy, place, center(bumpy, place)), 1, 1e-12);
  EXPECT_NEAR(winding(bumpy, place, center(bumpy, place) + Vec{0, 0, 1.5}), 0, 1e-12);
  EXPECT_NEAR(winding(bumpy, place, {}), 0, 1e-12);
}

// Closed: each edge is used once in each direction.
TEST(SecondOpinion, MakesClosedMeshes) {
  for (const Mesh& mesh : {bumpy_sphere(9, 8, 0.3), bumpy_sphere(10, 9, 0.3), box({1, 2, 3})}) {
    std::vector<std::pair<int, int>> edges;
    for (const auto& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) edges.emplace_back(t[i], t[(i + 1) % 3]);
    for (const auto& [p, q] : edges) {
      EXPECT_EQ(std::count(edges.begin(), edges.end(), std::pair(p, q)), 1);
      EXPECT_EQ(std::count(edges.begin(), edges.end(), std::pair(q, p)), 1);
    }
    EXPECT_GT(make_solid(mesh, 1).mass, 0);
  }
}

TEST(SecondOpinion, TreeAndBruteForceAgree) {
  const Solid bumpy = make_solid(bumpy_sphere(12, 11, 0.3), 1);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  int yes = 0, no = 0;
  for (int i = 0; i < 300; ++i) {
    const Quaternion p{unit(random), unit(random), unit(random), unit(random)},
        q{unit(random), unit(random), unit(random), unit(random)};
    const Vec way{unit(random), unit(random), unit(random)};
    const Vec shift = ((1.95 + 0.45 * unit(random)) / norm(way)) * way;
    const State a = at(0, 0, 0, p), b = at(shift.x, shift.y, shift.z, q);
    const bool answer = overlap(bumpy, a, bumpy, b, How::every_pair);
    EXPECT_EQ(overlap(bumpy, a, bumpy, b, How::tree), answer) << i;
    EXPECT_EQ(overlap(bumpy, b, bumpy, a, How::tree), answer) << i;
    ++(answer ? yes : no);
  }
  EXPECT_GT(yes, 50);
  EXPECT_GT(no, 50);
}

// A point that turns about the centroid: against the rotation matrix worked out by hand.
TEST(SecondOpinion, MovesAboutTheCentroid) {
  Mesh shifted = box({1, 1, 1});
  for (Vec& v : shifted.vertices) v = v + Vec{2, 0, 0};
  const Solid solid = make_solid(shifted, 1);
  State state = at(1, 0, 0);
  state.velocity = {0, 0, 3};
  state.spin = {0, 0, pi};
  state.acceleration = {0, 0, -2};
  const State later = moved(solid, state, 0.5);
  EXPECT_LT(norm(center(solid, later) - Vec{3, 0, 1.25}), 1e-15);
  EXPECT_LT(norm(later.position - Vec{3, -2, 1.25}), 1e-15);  // a quarter turn: the frame was 2 m behind in x
  EXPECT_LT(norm(later.velocity - Vec{0, 0, 2}), 1e-15);
  EXPECT_LT(distance(solid, moved(solid, later, -0.5), state), 1e-14);
}

}  // namespace

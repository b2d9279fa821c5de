// Exercise 2.2. Bodies made of a few cubes, so that all pairs can be tried at as many times as one likes.
#include "ex02_misses_again.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using fc::Vec3;
using fc::ca::Motion;
using fc::exercises::first_contact;
using fc::exercises::FirstContact;
using fc::hulls::HullModel;

constexpr double kTolerance = 1e-6;  // m

// Cubes of a given edge (m) about these places; each is one convex piece, one leaf.
HullModel cubes(const std::vector<Vec3>& places, double edge) {
  fc::Shape shape;
  shape.kind = fc::Shape::Kind::mesh;
  for (const Vec3& place : places) {
    const int first = static_cast<int>(shape.core.vertices.size());
    for (int k = 0; k < 8; ++k)
      shape.core.vertices.push_back(place + edge * Vec3((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2) - 0.5));
    for (const auto& [i, j, k] : std::initializer_list<std::array<int, 3>>{{0, 2, 1},
                                                                           {1, 2, 3},
                                                                           {4, 5, 6},
                                                                           {5, 7, 6},
                                                                           {0, 1, 4},
                                                                           {1, 5, 4},
                                                                           {2, 6, 3},
                                                                           {3, 6, 7},
                                                                           {0, 4, 2},
                                                                           {2, 4, 6},
                                                                           {1, 3, 5},
                                                                           {3, 7, 5}})
      shape.core.triangles.push_back({first + i, first + j, first + k});
  }
  return fc::hulls::build_hull_model(fc::hulls::build_model(shape));
}
Motion motion(const Vec3& position, const Vec3& velocity, const Vec3& spin) {
  fc::RigidBody body;
  body.position = position;
  body.velocity = velocity;
  body.spin = spin;
  return Motion(body);
}

struct Two {
  HullModel a;
  Motion motion_a;
  HullModel b;
  Motion motion_b;

  FirstContact ask(double interval, double tolerance = kTolerance, int most = 10000) const {
    return first_contact(a, motion_a, b, motion_b, interval, tolerance, most);
  }
  // Of all pairs of leaves, m.
  double gap_at(double t) const {
    const fc::ca::PairPose pose(motion_a, motion_b, t);
    double gap = std::numeric_limits<double>::infinity();
    for (const auto& x : a.tree.nodes)
      for (const auto& y : b.tree.nodes)
        if (x.leaf() && y.leaf())
          gap = std::min(gap, fc::ca::distance(a.convex(x), b.convex(y), pose, {1e-13, 1e-9, 128}).upper);
    return gap;
  }
  // The first time at which the gap is at most 1e-9 m, or -1, by small steps.
  double true_contact(double interval) const {
    for (int k = 1; k <= 1000; ++k)
      if (gap_at(interval * k / 1000) <= 1e-9) {
        double low = interval * (k - 1) / 1000, high = interval * k / 1000;
        for (int i = 0; i < 50; ++i) (gap_at((low + high) / 2) > 1e-9 ? low : high) = (low + high) / 2;
        return high;
      }
    return -1;
  }
};

// A's tip swings round to B's tip; the two hubs stay 0.2 m apart for ever.
Two arm() {
  return {cubes({{0, 0, 0}, {4, 0, 0}}, 1), motion({0, 0, 0}, {0, 0, 0}, {0, 0, 2}),
          cubes({{0, 0, 1.2}, {0, 4, 0}}, 1), motion({0, 0, 0}, {0, 0, 0}, {0, 0, 0})};
}
// 4 by 4 by 4 cubes, a grid with gaps.
std::vector<Vec3> grid(double pitch) {
  std::vector<Vec3> places;
  for (int k = 0; k < 64; ++k) places.push_back(pitch * Vec3(k % 4 - 1.5, k / 4 % 4 - 1.5, k / 16 - 1.5));
  return places;
}
std::string status_of(const FirstContact& answer) {
  return fc::ca::name_of(answer.status);
}
std::string says(const FirstContact& answer) {
  return "the answer was `" + status_of(answer) + "` at " + std::to_string(answer.toc) + " s";
}

TEST(Ex02MissesAgain, SeesTheFarPairThatIsFast) {
  const Two two = arm();
  const double contact = two.true_contact(1);
  ASSERT_GT(contact, 0) << "s: of the test itself, whose arm has to hit";
  const FirstContact answer = two.ask(1);
  ASSERT_EQ(status_of(answer), "contact")
      << says(answer) << ", but at " << contact << " s the arm's tip hits: it is far away at first, and fast";
  EXPECT_LE(answer.toc, contact) << "s: a time of contact is never late";
}

TEST(Ex02MissesAgain, ContactMeansWithinTheTolerance) {
  Two two{cubes({{0, 0, 0}, {1.5, 0.5, 0}}, 1), motion({0, 0, 0}, {2, 0, 0}, {0, 0.3, 1}),
          cubes({{0, 0, 0}, {0, 1.5, 0.3}}, 1), motion({5, 0, 0}, {0, 0, 0}, {0.2, 0, 0})};
  for (const double tolerance : {1e-2, 1e-4, 1e-7, 1e-10}) {
    const FirstContact answer = two.ask(3, tolerance);
    ASSERT_EQ(status_of(answer), "contact")
        << says(answer) << " with a tolerance of " << tolerance << " m, but A flies into B";
    const double gap = two.gap_at(answer.toc);
    EXPECT_GT(gap, 0) << "m: the gap at toc, with a tolerance of " << tolerance << " m";
    EXPECT_LE(gap, tolerance) << "m: the gap at toc; a short step alone is no contact";
  }
}

TEST(Ex02MissesAgain, ABulletIsNotThereYet) {
  Two two{cubes({{0, 0, 0}}, 0.01), motion({0, 0, 0}, {900, 0, 0}, {0, 0, 20000}), cubes({{0, 0, 0}}, 1),
          motion({20, 0, 0}, {0, 0, 0}, {0, 0, 0})};
  const FirstContact answer = two.ask(1);
  ASSERT_EQ(status_of(answer), "contact") << says(answer) << ", but the bullet flies straight at the cube";
  EXPECT_LE(two.gap_at(answer.toc), kTolerance)
      << "m: at 900 m/s, 1e-5 s are 9 mm: a step that is short in time may be long in space";
}

TEST(Ex02MissesAgain, SaysThatALimitWasReached) {
  const Two two = arm();
  const FirstContact answer = two.ask(1, 1e-9, 2);
  ASSERT_EQ(status_of(answer), "unresolved")
      << says(answer) << ", but two steps prove only that the bodies are clear for a while";
  EXPECT_GT(answer.toc, 0) << "s: until then they are clear";
  EXPECT_LE(answer.toc, two.true_contact(1)) << "s: nothing was proved beyond the contact";
}

TEST(Ex02MissesAgain, IsNeverLate) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vec = [&](double size) { return Vec3(size * Vec3(u(random), u(random), u(random))); };
  int contacts = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vec3> places_a, places_b;
    for (int k = 0; k < 4; ++k) {
      places_a.push_back(vec(1.5) + Vec3(2 * k, 0, 0));
      places_b.push_back(vec(1.5) + Vec3(0, 2 * k, 0));
    }
    const Two two{cubes(places_a, 0.8), motion(vec(1), vec(3), vec(4)), cubes(places_b, 0.8),
                  motion(vec(6), vec(3), vec(4))};
    if (two.gap_at(0) < 0.01) continue;
    const FirstContact answer = two.ask(1);
    ASSERT_NE(status_of(answer), "unresolved")
        << says(answer) << " after 10,000 steps: some hundreds decide it; are the steps longer than nothing?";
    contacts += answer.status == fc::ca::Status::contact;
    for (int k = 0; k <= 300; ++k) {
      const double t = answer.toc * k / 300;
      ASSERT_GT(two.gap_at(t), 0) << "m: " << says(answer) << ", but already at " << t
                                  << " s the bodies touch";
    }
  }
  EXPECT_GE(contacts, 5) << "contacts among 100 random pairs: some are there to be found";
}

TEST(Ex02MissesAgain, HullsThatOverlapAreNoContact) {
  // B's cube hovers between A's two: inside the hull of both.
  const Two two{cubes({{-2, 0, 0}, {2, 0, 0}}, 1), motion({0, 0, 0}, {0, 0, 0}, {0, 0, 0}),
                cubes({{0, 0, 0}}, 1), motion({0, 0, 0}, {0.5, 0, 0}, {0, 0, 0})};
  const FirstContact answer = two.ask(5);
  ASSERT_EQ(status_of(answer), "contact") << says(answer) << ", but the two do meet";
  EXPECT_NEAR(answer.toc, 2, 3 * kTolerance) << "s: 1 m at 0.5 m/s; a hull that is not a leaf's is no body";
}

TEST(Ex02MissesAgain, StopsBeforeTheyTouch) {
  for (const double speed :
       {0.5, 1.0, 3.0, 7.0}) {  // without spin the bound is exact: a step gets where it aims
    const Two two{cubes({{0, 0, 0}, {0, 3, 0}}, 1), motion({0, 0, 0}, {speed, 0, 0}, {0, 0, 0}),
                  cubes({{0, 0, 0}, {0, 3, 0}}, 1), motion({2, 0, 0}, {0, 0, 0}, {0, 0, 0})};
    const FirstContact answer = two.ask(5);
    ASSERT_EQ(status_of(answer), "contact") << says(answer) << ", but the two do meet";
    const double gap = two.gap_at(answer.toc);
    EXPECT_GT(gap, 0) << "m: the gap at toc, at " << speed << " m/s: whoever aims at contact gets there";
    EXPECT_LE(gap, kTolerance) << "m: the gap at toc; `contact` means that no more is left";
  }
}

TEST(Ex02MissesAgain, OpensTheLargerNode) {
  const Two two{cubes(grid(4), 1), motion({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), cubes(grid(0.2), 0.1),
                motion({0, 2, 20}, {0, 0, -3}, {0, 0, 1})};
  const FirstContact answer = two.ask(8);
  ASSERT_NE(status_of(answer), "unresolved") << says(answer) << ", but 10,000 steps are more than enough";
  const double each = static_cast<double>(answer.node_pairs) / static_cast<double>(answer.visited.size());
  EXPECT_LE(each, 60)
      << "pairs of nodes per step: a node of A, 12 m wide, stays too large for B, 0.7 m wide, "
      << "until it is opened itself; to open B first is of no use";
}

TEST(Ex02MissesAgain, OpensOnlyWhatCouldShortenTheStep) {
  const Two two{cubes(grid(2), 1), motion({0, 0, 0}, {0, 0, 0}, {0.3, 0, 0.1}), cubes(grid(2), 1),
                motion({11, 1, 0}, {-3, 0, 0}, {0, 0.2, 0.3})};
  const FirstContact answer = two.ask(4);
  ASSERT_EQ(status_of(answer), "contact") << says(answer) << ", but the two do meet";
  const double each = static_cast<double>(answer.node_pairs) / static_cast<double>(answer.visited.size());
  EXPECT_LE(each, 120) << "pairs of nodes per step, of 64 times 64 pairs of cubes";
}

}  // namespace

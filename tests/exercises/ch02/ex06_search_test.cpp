// Exercise 2.6. Bodies of a few cubes, whose gaps are known at any time, and chapter 1's pieces under observation.
#include "ex06_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ch01_convex_advancement/gjk.hpp"
#include "ch02_hull_hierarchy/advance.hpp"

namespace {

using fc::Vec3;
using fc::ca::Motion;
using fc::hulls::HullModel;
using fc::hulls::TimeOfContact;
using fc::mine::FirstContact;
using fc::mine::SearchOptions;

// Chapter 1's pieces, by its fast functions, and a record of how they were called.
struct Record {
  std::int64_t gaps = 0;
  std::vector<double> duration;  // s, of each speed bound: from its time to the interval's end
};
Record record;

fc::ca::clear::Gap seen_gap(const fc::ca::Convex& a, const fc::ca::Convex& b, const fc::ca::PairPose& pose,
                            double accuracy, fc::ca::clear::ClosestPointFunction*) {
  if (++record.gaps > 200000) throw std::runtime_error("200,000 looks: an endless loop?");
  if (!(accuracy > 0))
    throw std::runtime_error("gap() was asked for an accuracy of " + std::to_string(accuracy) + " m");
  const fc::ca::GjkResult g = fc::ca::distance(a, b, pose, {accuracy, 0, 128});
  fc::ca::clear::Gap gap;
  gap.lower = g.lower;
  gap.upper = g.upper;
  gap.normal = g.normal;
  return gap;
}
double seen_speed(const Vec3& n, const fc::ca::clear::Mover& a, const fc::ca::clear::Mover& b,
                  double duration) {
  record.duration.push_back(duration);
  return n.dot(a.velocity - b.velocity) + std::max(0.0, n.dot(a.acceleration - b.acceleration)) * duration +
         n.cross(a.spin).norm() * a.reach + n.cross(b.spin).norm() * b.reach;
}

// Cubes of a given edge (m) about these places; each is one piece.
fc::hulls::Model cubes(const std::vector<Vec3>& places, double edge) {
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
  return fc::hulls::build_model(shape);
}

struct Two {
  fc::hulls::Model model_a, model_b;
  HullModel a, b;
  Motion motion_a, motion_b;

  Two(const std::vector<Vec3>& places_a, const std::vector<Vec3>& places_b, double edge = 1)
      : model_a(cubes(places_a, edge)),
        model_b(cubes(places_b, edge)),
        a(fc::hulls::build_hull_model(model_a)),
        b(fc::hulls::build_hull_model(model_b)) {}

  Two& move(const Vec3& position_a, const Vec3& velocity_a, const Vec3& spin_a,
            const Vec3& acceleration_a = Vec3::Zero()) {
    fc::RigidBody body;
    body.position = position_a;
    body.velocity = velocity_a;
    body.spin = spin_a;
    motion_a = Motion(body, acceleration_a);
    motion_b = Motion(fc::RigidBody());
    return *this;
  }
  FirstContact ask(const SearchOptions& options) const {
    record = {};
    fc::ca::clear::Pieces pieces;
    pieces.gap = seen_gap;
    pieces.speed_bound = seen_speed;
    return fc::mine::search(a, motion_a, b, motion_b, options, pieces);
  }
  // Chapter 2's fast search.
  TimeOfContact fast(double interval) const {
    fc::hulls::TocOptions options;
    options.interval = interval;
    return fc::hulls::time_of_contact(model_a, motion_a, model_b, motion_b, options);
  }
  // m, the gap of all pairs of pieces.
  double gap(double t) const {
    return fc::hulls::model_distance(model_a, model_b, fc::ca::PairPose(motion_a, motion_b, t), 1e-9).upper;
  }
};

SearchOptions options_of(double interval) {
  SearchOptions options;
  options.interval = interval;
  return options;
}
std::string says(const FirstContact& found) {
  std::ostringstream text;
  text << "the answer was `" << found.status << "` at " << found.time << " s after " << found.looks
       << " looks";
  return text.str();
}

Two one_cube_each() {
  Two two({Vec3::Zero()}, {Vec3::Zero()});
  two.move(Vec3(-3, 0, 0), Vec3(2, 0, 0), Vec3::Zero());
  return two;
}
// Two combs of five teeth that reach between each other: their hulls overlap, and no teeth meet for a while.
Two combs(double speed) {
  std::vector<Vec3> comb_a, comb_b;
  for (int k = 0; k < 5; ++k) {
    comb_a.emplace_back(4 * k, 0, 0);
    comb_b.emplace_back(4 * k + 2, 0, 0);
  }
  Two two(comb_a, comb_b);
  two.move(Vec3::Zero(), Vec3(speed, 0, 0), Vec3::Zero());
  return two;
}
Two clouds(int seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vector = [&](double scale) -> Vec3 { return scale * Vec3(u(random), u(random), u(random)); };
  std::vector<Vec3> places_a, places_b;
  for (int k = 0; k < 12; ++k) {
    places_a.push_back(vector(1.5));
    places_b.push_back(vector(1.5));
  }
  Two two(places_a, places_b, 0.2);
  two.move(Vec3(-4, 0, 0) + vector(0.5), Vec3(4, 0, 0) + vector(1), vector(1.5), vector(0.5));
  return two;
}

TEST(Ex06Search, TwoCubesAreChapterOne) {
  const Two two = one_cube_each();  // 2 m apart, 2 m/s
  const FirstContact found = two.ask(options_of(5));
  ASSERT_EQ(found.status, FirstContact::Status::contact)
      << says(found) << ", but the cubes are 2 m apart and close in at 2 m/s";
  EXPECT_NEAR(found.time, 1, 1e-6) << "s: they meet after 1 s";
  EXPECT_LE(found.time, 1 - 0.5e-6 / 2 + 1e-12)
      << "s: a step aims at the target gap of 5e-7 m, never at 0: later there may be no plane";
  EXPECT_EQ(found.piece_a, 0) << "the piece of A";
  EXPECT_EQ(found.piece_b, 0) << "the piece of B";
  EXPECT_EQ(found.looks, record.gaps) << "looks: each is one call of gap()";
  EXPECT_LE(found.looks, 4) << "looks: along a straight flight the first step is exact";
}

TEST(Ex06Search, FindsTheFirstOfManyContacts) {
  int contacts = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const Two two = clouds(seed);
    const FirstContact found = two.ask(options_of(2));
    const TimeOfContact truth = two.fast(2);
    const bool meets = truth.status == TimeOfContact::Status::reached;
    ASSERT_EQ(found.status == FirstContact::Status::contact, meets)
        << says(found) << ", but chapter 2's fast search says `" << truth.status << "` at " << truth.time
        << " s (clouds " << seed << ")";
    if (!meets) continue;
    ++contacts;
    ASSERT_NEAR(found.time, truth.time, 1e-5)
        << "s: the first contact of clouds " << seed << " is there; other pieces meet later";
    ASSERT_LE(two.gap(found.time), 1e-6)
        << "m between the bodies at " << found.time << " s: that is no contact yet (clouds " << seed << ")";
    ASSERT_GE(two.gap(found.time), 0.4e-6)
        << "m between the bodies at " << found.time
        << " s: nearer than the target that each step is to keep (clouds " << seed << ")";
  }
  ASSERT_GT(contacts, 10) << "clouds that meet";
}

TEST(Ex06Search, HullsThatOverlapAreOpened) {
  const Two two = combs(0.5);  // the teeth are 1 m apart
  const FirstContact found = two.ask(options_of(10));
  ASSERT_EQ(found.status, FirstContact::Status::contact) << says(found) << ", but the teeth meet after 2 s";
  EXPECT_NEAR(found.time, 2, 1e-5)
      << "s: the hulls of the combs overlap from the start, but the teeth are 1 m apart: "
      << "only two leaves can be a contact";
}

TEST(Ex06Search, LooksAtNothingBeyondTheContact) {
  for (int seed = 0; seed < 10; ++seed) {
    const Two two = clouds(seed);
    const TimeOfContact truth = two.fast(2);
    const FirstContact found = two.ask(options_of(2));
    ASSERT_GT(found.looks, 1) << "looks: the roots alone tell nothing of 144 pairs of pieces";
    for (const double duration : record.duration)
      ASSERT_GE(duration, 2 - truth.time - 1e-6)
          << "s until the interval's end, asked of the speed bound: a pair was looked at at " << 2 - duration
          << " s, but the first contact is at " << truth.time << " s: that pair waits behind others";
  }
}

TEST(Ex06Search, WhatIsProvedIsNotProvedAgain) {
  const Two two = combs(-0.001);  // hardly moves: 25 pairs of teeth, each with one step to the end
  const FirstContact found = two.ask(options_of(1));
  ASSERT_EQ(found.status, FirstContact::Status::clear)
      << says(found) << ", but the teeth are 1 m apart and move by 1 mm";
  EXPECT_EQ(found.time, 1) << "s: clear for the whole interval";
  EXPECT_LE(found.looks, 81) << "looks: there are 9 times 9 pairs of nodes, and none needs two looks";
  const Two fast = clouds(1);
  EXPECT_LE(fast.ask(options_of(2)).looks, 400)
      << "looks for two clouds of 12 cubes: children begin with the time of the pair that they come from, and the larger "
      << "of two nodes is opened";
}

TEST(Ex06Search, ALeafGoesOnFromWhereItIs) {
  // A cube that spins on its way: each step leaves some of the gap.
  Two two = one_cube_each();
  two.move(Vec3(-3, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1));
  const FirstContact found = two.ask(options_of(5));
  ASSERT_EQ(found.status, FirstContact::Status::contact)
      << says(found) << ", but the cube flies right at the other one";
  EXPECT_LE(two.gap(found.time), 1e-6) << "m between the cubes: that is no contact yet";
  EXPECT_LE(found.looks, 60) << "looks: each step is a share of what is left";
}

TEST(Ex06Search, UsesTheVelocityOfNow) {
  Two two = one_cube_each();
  // Starts away from B with 1 m/s, and is pulled back: x = -3 - t + t^2, so the gap of 2 m is used up at t = 2.
  two.move(Vec3(-3, 0, 0), Vec3(-1, 0, 0), Vec3::Zero(), Vec3(2, 0, 0));
  const FirstContact found = two.ask(options_of(2.1));
  ASSERT_EQ(found.status, FirstContact::Status::contact) << says(found) << ", but the cubes meet after 2 s";
  EXPECT_NEAR(found.time, 2, 1e-5) << "s: the bound is of the velocity at the pair's time, not at the start";
}

TEST(Ex06Search, SaysThatNothingMeets) {
  Two two = one_cube_each();
  const FirstContact before = two.ask(options_of(0.9));
  EXPECT_EQ(before.status, FirstContact::Status::clear)
      << says(before) << ", but the cubes meet after 1 s, and the interval ends before";
  EXPECT_EQ(before.time, 0.9) << "s: clear for the whole interval";
  two.move(Vec3(-3, 0, 0), Vec3(-2, 0, 0), Vec3::Zero());
  const FirstContact away = two.ask(options_of(1e6));
  EXPECT_EQ(away.status, FirstContact::Status::clear) << says(away) << ", but the cubes part for ever";
  EXPECT_EQ(away.looks, 1) << "looks: a closing speed that is not positive settles the matter";
}

TEST(Ex06Search, SaysThatTheLooksDidNotSuffice) {
  const Two two = clouds(1);
  const FirstContact all = two.ask(options_of(2));
  for (const int most : {1, 5, 12}) {
    SearchOptions options = options_of(2);
    options.most_looks = most;
    const FirstContact found = two.ask(options);
    ASSERT_EQ(found.status, FirstContact::Status::limit)
        << says(found) << ", but " << most << " looks prove only that all is clear for a while";
    EXPECT_EQ(found.looks, most) << "looks: all that were allowed, and no more";
    EXPECT_GT(found.time, 0) << "s: one look at the roots is a proof";
    EXPECT_LE(found.time, all.time) << "s: nothing was proved beyond the first contact";
  }
}

TEST(Ex06Search, TellsWhatTouchesAtTheStart) {
  Two two = one_cube_each();
  two.move(Vec3(-1 - 0.8e-6, 0, 0), Vec3(-1, 0, 0), Vec3::Zero());  // 0.8e-6 m apart, and parting
  SearchOptions options = options_of(1);
  options.start = 1e-6;
  const FirstContact touching = two.ask(options);
  EXPECT_EQ(touching.status, FirstContact::Status::contact)
      << says(touching) << ", but at t = 0 the gap of 8e-7 m is less than `start`, 1e-6 m";
  EXPECT_EQ(touching.time, 0) << "s: at the start";
  options.start = -1;
  const FirstContact parting = two.ask(options);
  EXPECT_EQ(parting.status, FirstContact::Status::clear)
      << says(parting) << ", but with start = -1 no gap of t = 0 is a contact, and the cubes part";
}

}  // namespace

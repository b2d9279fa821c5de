// Exercise 3.3. Closed forms: equal balls in a row sort their velocities, whichever is hit first.
#include "ex03_one_by_one.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <vector>

#include "ch03_impulse_lcp/impact.hpp"

namespace {

using fc::RigidBody;
using fc::Vec3;
using fc::exercises::Choice;
using fc::exercises::resolve_one_by_one;
using fc::exercises::Sequence;
using fc::lcp::Contact;
using fc::lcp::Status;
using Speeds = std::vector<double>;

constexpr double kSlowest = 1e-12;  // m/s
constexpr double kRounding = 1e-14;

struct Scene {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;

  Sequence resolve(Choice choice, double slowest = kSlowest, int most = 1000) {
    return resolve_one_by_one(bodies, contacts, choice, slowest, most);
  }
  double energy() const {
    double sum = 0;
    for (const RigidBody& body : bodies) sum += body.is_static() ? 0 : body.kinetic_energy();
    return sum;
  }
  Speeds speeds() const {
    Speeds x;
    for (const RigidBody& body : bodies) x.push_back(body.velocity.x());
    return x;
  }
};

RigidBody ball(const Vec3& position, const Vec3& velocity, double mass = 1) {
  RigidBody body;
  body.position = position;
  body.velocity = velocity;
  body.set_mass({mass, Vec3::Zero(), 0.1 * mass * fc::Mat3::Identity()});
  return body;
}
// Balls of diameter 1 in a row along x, touching.
Scene row(const Speeds& speeds, double restitution = 1, const Speeds& masses = {}) {
  Scene scene;
  for (std::size_t i = 0; i < speeds.size(); ++i)
    scene.bodies.push_back(ball({i + 0.0, 0, 0}, {speeds[i], 0, 0}, masses.empty() ? 1 : masses[i]));
  for (int i = 0; i + 1 < static_cast<int>(speeds.size()); ++i)
    scene.contacts.push_back({i, i + 1, {i + 0.5, 0, 0}, Vec3::UnitX(), 0, restitution});
  return scene;
}
void expect_speeds(const Scene& scene, const Speeds& expected, double tolerance, const char* meaning) {
  const Speeds got = scene.speeds();
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(got[i], expected[i], tolerance) << "m/s, body " << i << " along x: " << meaning;
}
// A cue ball comes up and meets two balls that lie side by side, touching neither each other.
Scene break_shot(double aside, bool left_first) {
  Scene scene;
  const Vec3 right(0.5, std::sqrt(0.75), 0), left(-0.5, std::sqrt(0.75), 0);
  scene.bodies = {ball({0, 0, 0}, {aside, 1, 0}), ball(right, {0, 0, 0}), ball(left, {0, 0, 0})};
  scene.contacts = {{0, 1, 0.5 * right, right, 0, 1}, {0, 2, 0.5 * left, left, 0, 1}};
  if (left_first) std::swap(scene.contacts[0], scene.contacts[1]);
  return scene;
}

TEST(Ex03OneByOne, ABallOnAWall) {
  Scene scene = row({3, 0}, 0.5);
  scene.bodies[1] = RigidBody{};  // static
  const Sequence got = scene.resolve(Choice::in_turn);
  EXPECT_EQ(got.status, Status::solved) << "solved: after a single hit nothing approaches";
  EXPECT_EQ(got.hits, 1) << "hits: a single one settles it";
  expect_speeds(scene, {-1.5, 0}, kRounding,
                "restitution 1/2 sends it back with half its speed; the wall stays");
}

TEST(Ex03OneByOne, NewtonsCradlePassesTheBlowOn) {
  for (const Choice choice : {Choice::in_turn, Choice::fastest}) {
    Scene scene = row({1, 0, 0, 0, 0});
    const Sequence got = scene.resolve(choice);
    EXPECT_EQ(got.status, Status::solved) << "after four hits nothing approaches";
    EXPECT_EQ(got.hits, 4) << "hits: one for each contact, one after the other";
    expect_speeds(scene, {0, 0, 0, 0, 1}, kRounding, "the last ball flies off alone, as the toy's does");
    scene = row({1, 1, 0, 0, 0});
    scene.resolve(choice);
    expect_speeds(scene, {0, 0, 0, 1, 1}, kRounding, "two come in, two fly off");
  }
}

TEST(Ex03OneByOne, ASqueezeComesApart) {
  Scene scene = row({1, 0, -1});
  const Sequence got = scene.resolve(Choice::in_turn);
  EXPECT_EQ(got.status, Status::solved) << "after three hits nothing approaches";
  EXPECT_EQ(got.hits, 3)
      << "hits: left, right, and left again, since the right one sent the middle ball back";
  expect_speeds(scene, {-1, 0, 1}, kRounding, "the outer balls go back, and the middle one stays");
}

// Equal balls with restitution 1 swap their velocities. Each hit removes one pair that stands in the wrong order, so
// the number of hits is the number of such pairs, whichever is first (Knauf and Stepan).
TEST(Ex03OneByOne, EqualBallsSortTheirVelocities) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    Speeds speeds(2 + trial % 8);
    for (double& v : speeds) v = static_cast<double>(random() % 1000) / 100;
    int wrong = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i)
      for (std::size_t k = i + 1; k < speeds.size(); ++k) wrong += speeds[i] > speeds[k];
    Speeds sorted = speeds;
    std::sort(sorted.begin(), sorted.end());
    for (const Choice choice : {Choice::in_turn, Choice::fastest}) {
      Scene scene = row(speeds);
      const Sequence got = scene.resolve(choice);
      ASSERT_EQ(got.hits, wrong)
          << "hits: as many as there are pairs of balls of which the left one is faster";
      ASSERT_EQ(got.status, Status::solved) << "after " << wrong << " hits nothing approaches";
      expect_speeds(scene, sorted, 1e-12, "the slowest must be on the left, or something still approaches");
    }
  }
}

TEST(Ex03OneByOne, ABallBesideAWall) {
  Scene scene = row({2, 0, 0});
  scene.bodies[2] = RigidBody{};
  const Sequence got = scene.resolve(Choice::in_turn);
  EXPECT_EQ(got.hits, 3) << "hits: ball on ball, ball on wall, ball on ball again";
  expect_speeds(
      scene, {-2, 0, 0}, kRounding,
      "the first ball returns with its speed; an impulse from old velocities would double the energy");
  EXPECT_NEAR(scene.energy(), 2, 1e-14) << "J: restitution 1 keeps the kinetic energy";
}

TEST(Ex03OneByOne, TheOrderDecidesABreakShot) {
  // By hand: the first hit takes sqrt(3)/2 m/s out of the cue ball, the second half of that.
  const double first = std::sqrt(0.75), second = first / 2;
  for (const bool left_first : {false, true}) {
    Scene scene = break_shot(0, left_first);
    const Sequence got = scene.resolve(Choice::in_turn);
    EXPECT_EQ(got.hits, 2) << "hits: the cue ball meets each ball once";
    EXPECT_NEAR(scene.bodies[left_first ? 2 : 1].velocity.norm(), first, kRounding)
        << "m/s, the ball whose contact stands first in the list: it gets the cue ball's full blow";
    EXPECT_NEAR(scene.bodies[left_first ? 1 : 2].velocity.norm(), second, kRounding)
        << "m/s, the other ball: the scene is symmetric, the answer is not";
  }
  Scene together = break_shot(0, false);
  ASSERT_EQ(fc::lcp::resolve_impact(together.bodies, together.contacts).status, Status::solved)
      << "the chapter's solver, for comparison";
  EXPECT_NEAR(together.bodies[1].velocity.norm(), together.bodies[2].velocity.norm(), kRounding)
      << "m/s: at once, both get the same";
}

TEST(Ex03OneByOne, TheFastestIsHitFirst) {
  for (const bool left_first : {false, true}) {  // the cue ball drifts to the left
    Scene scene = break_shot(-0.1, left_first), in_turn = break_shot(-0.1, true);
    scene.resolve(Choice::fastest);
    in_turn.resolve(Choice::in_turn);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE((scene.bodies[k].velocity - in_turn.bodies[k].velocity).norm(), kRounding)
          << "m/s, body " << k
          << ": the left ball is approached faster, wherever its contact stands in the list";
  }
  Scene tie = break_shot(0, true);
  tie.resolve(Choice::fastest);
  EXPECT_GT(tie.bodies[2].velocity.norm(), tie.bodies[1].velocity.norm())
      << "m/s: of contacts that approach equally fast the one with the smallest index is hit first";
}

TEST(Ex03OneByOne, InTurnGoesOnWhereItWas) {
  Scene scene = row({1, 0, 2, 0});
  EXPECT_EQ(scene.resolve(Choice::in_turn, kSlowest, 2).hits, 2) << "hits, as many as were allowed";
  expect_speeds(scene, {0, 1, 0, 2}, kRounding, "contact 0; contact 1 does not approach; contact 2");
  scene = row({3, 2, 1, 0});
  scene.resolve(Choice::in_turn, kSlowest, 3);
  expect_speeds(scene, {2, 1, 0, 3}, kRounding,
                "contacts 0, 1 and 2, though 0 approaches again after the second hit; whoever begins anew "
                "after each hit comes elsewhere");
}

TEST(Ex03OneByOne, ACornerOfABox) {
  Scene scene;
  scene.bodies.resize(2);
  scene.bodies[1].position = {0, 0, 0.5};
  scene.bodies[1].velocity = {0, 0, -2};
  scene.bodies[1].set_mass(fc::box_mass({1, 1, 1}, 1));
  scene.contacts = {{0, 1, {0.5, 0.5, 0}, Vec3::UnitZ(), 0, 0.5}};
  EXPECT_EQ(scene.resolve(Choice::in_turn).hits, 1) << "hits: a single contact is served once";
  // a = 1/m + |r x n|^2 / I = 1 + (1/2) 6 = 4 /kg, j = 1.5 * 2 / 4 N s.
  EXPECT_NEAR(scene.bodies[1].velocity.z(), -1.25, kRounding)
      << "m/s, the centre: a blow at a corner is soft (3/4 N s), because the cube turns away";
  EXPECT_NEAR(scene.bodies[1].spin.x(), 2.25, kRounding) << "rad/s: r x j, divided by 1/6 kg m^2";
  EXPECT_NEAR(fc::lcp::contact_velocity(scene.bodies, scene.contacts[0]), 1, kRounding)
      << "m/s, the corner: half the speed at which it came";
}

TEST(Ex03OneByOne, WithoutRestitutionItNeverEnds) {
  // (1, 0, 0): the approach halves with each hit, 1, 1/2, 1/4, ...; 2^-20 is the first below 1e-6.
  Scene scene = row({1, 0, 0}, 0);
  const Sequence got = scene.resolve(Choice::in_turn, 1e-6);
  EXPECT_EQ(got.status, Status::solved) << "nothing approaches at more than 1e-6 m/s";
  EXPECT_EQ(got.hits, 20) << "hits until the approach, halved by each, is below 1e-6 m/s";
  expect_speeds(scene, {1. / 3, 1. / 3, 1. / 3}, 1e-6, "all go on together");
  scene = row({1, 0, 0}, 0);
  const Sequence short_one = scene.resolve(Choice::in_turn, 1e-6, 10);
  EXPECT_EQ(short_one.hits, 10) << "hits: no more than ten were allowed";
  EXPECT_EQ(short_one.status, Status::limit) << "contacts still approach at 1e-3 m/s; that is not solved";
  scene = row({1, 0, 0}, 0);
  EXPECT_EQ(scene.resolve(Choice::in_turn, 1e-6, 20).status, Status::solved)
      << "the twentieth hit was the last that was needed, and the last that was allowed";
}

TEST(Ex03OneByOne, WhatSeparatesIsNotPulledBack) {
  Scene scene = row({-1, 0, 2});
  const Sequence got = scene.resolve(Choice::fastest);
  EXPECT_EQ(got.hits, 0) << "hits: everything separates";
  EXPECT_EQ(got.status, Status::solved) << "solved: nothing approaches, from the start";
  EXPECT_EQ(scene.speeds(), (Speeds{-1, 0, 2})) << "m/s: what separates is left alone";
  scene.contacts.clear();
  EXPECT_EQ(scene.resolve(Choice::in_turn).status, Status::solved) << "no contacts, nothing to do";
}

// A lift that comes down on a floor; and beside them a ball on the floor.
TEST(Ex03OneByOne, WhatCannotMoveIsPassedOver) {
  for (const Choice choice : {Choice::in_turn, Choice::fastest}) {
    Scene scene = row({5, 0, -1});
    scene.bodies[0] = scene.bodies[1] = RigidBody{};
    scene.bodies[0].velocity = {5, 0, 0};
    const Sequence got = scene.resolve(choice);
    EXPECT_EQ(got.status, Status::solved) << "solved: all that impulses can do was done";
    EXPECT_EQ(got.hits, 1) << "hits: the ball's; no impulse stops what has an infinite mass";
    expect_speeds(scene, {5, 0, 1}, kRounding,
                  "the lift goes on, and the ball comes back; 1/0 kg is no mass");
  }
}

TEST(Ex03OneByOne, MixedRestitutionsGainNoEnergy) {
  Scene scene = row({0, 1, -1}), together;
  scene.contacts[0].restitution = 0;
  together = scene;
  EXPECT_EQ(scene.resolve(Choice::in_turn).hits, 2) << "hits: the right contact, and then the left one";
  expect_speeds(scene, {-0.5, -0.5, 1}, kRounding, "swap on the right, then the left pair goes on together");
  EXPECT_NEAR(scene.energy(), 0.75, kRounding) << "J, of 1 J before: each hit takes energy, or none";
  ASSERT_EQ(fc::lcp::resolve_impact(together.bodies, together.contacts).status, Status::solved)
      << "the chapter's solver, for comparison";
  EXPECT_GT(together.energy(), 1.3) << "J: at once, the same impact makes 4/3 J out of 1 J";
}

TEST(Ex03OneByOne, NoHitMakesEnergyOrMomentum) {
  std::mt19937_64 random(5);
  const auto number = [&] { return static_cast<double>(random() % 1000) / 500 - 1; };
  for (int trial = 0; trial < 100; ++trial) {
    Scene scene;
    for (int k = 0; k < 6; ++k) {
      RigidBody body = ball({number(), number(), number()}, {number(), number(), number()});
      body.set_mass(fc::box_mass({1.1 + number(), 1.1 + number(), 1.1 + number()}, 1));
      body.spin = {number(), number(), number()};
      scene.bodies.push_back(body);
    }
    for (int i = 0; i < 8; ++i) {
      const Vec3 n = Vec3(number(), number(), number() + 1.1).normalized();
      scene.contacts.push_back({i % 6, (i + 1 + i / 6) % 6, {number(), number(), number()}, n, 0, 0.3});
    }
    const auto angular = [&] {
      Vec3 sum = Vec3::Zero();
      for (const RigidBody& body : scene.bodies) sum += body.angular_momentum();
      return sum;
    };
    const double before = scene.energy();
    const Vec3 turning = angular();
    const Sequence got = scene.resolve(Choice::fastest, 1e-6, 5000);
    ASSERT_LE(scene.energy(), before * (1 + 1e-12)) << "J: with restitution 0.3 each hit takes energy away";
    ASSERT_LE((angular() - turning).norm(), 1e-12 * (1 + turning.norm()))
        << "kg m^2/s: one impulse and its reaction at one point leave the angular momentum as it was";
    ASSERT_GT(got.hits, 0) << "hits: something approaches";
    if (got.status != Status::solved) continue;
    for (const Contact& contact : scene.contacts)
      ASSERT_GE(fc::lcp::contact_velocity(scene.bodies, contact), -1e-6)
          << "m/s: solved, and yet it approaches";
  }
}

}  // namespace

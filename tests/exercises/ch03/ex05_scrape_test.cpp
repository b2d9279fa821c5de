// Exercise 3.5. A ball has closed forms; for other bodies the law itself is the oracle.
#include "ex05_scrape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using fc::Mat3;
using fc::RigidBody;
using fc::Vec3;
using fc::exercises::scrape;
using fc::exercises::Scrape;
using fc::exercises::Touch;

// A solid ball of 2 kg and radius 1/2 that touches the floor z = 0 below it.
RigidBody ball(const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  RigidBody body;
  body.position = {0, 0, 0.5};
  body.velocity = velocity;
  body.spin = spin;
  body.set_mass({2, Vec3::Zero(), 0.4 * 2 * 0.25 * Mat3::Identity()});
  return body;
}
Touch floor(double restitution, double friction) {
  return {Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), restitution, friction};
}
// A box of 1 kg, turned at random, that is hit at a random point of its lower side.
struct Hit {
  RigidBody body;
  Touch touch;
};
Hit random_hit(std::mt19937_64& random, double restitution, double friction) {
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  Hit hit;
  const Vec3 size = Vec3(1, 1.3, 0.8) + 0.2 * vector();
  hit.body.position = vector();
  hit.body.orientation = Eigen::AngleAxisd(3 * any(random), vector().normalized());
  hit.body.set_mass(fc::box_mass(size, 1));
  hit.touch.normal = vector().normalized();
  hit.touch.along = hit.touch.normal.unitOrthogonal();
  hit.touch.point = hit.body.position - 0.5 * hit.touch.normal + 0.3 * vector();
  hit.touch.restitution = restitution;
  hit.touch.friction = friction;
  hit.body.velocity = vector() - 2 * hit.touch.normal;
  hit.body.spin = vector();
  return hit;
}

TEST(Ex05Scrape, WithoutFrictionItBounces) {
  RigidBody body = ball({1, 0, -3});
  const Scrape j = scrape(body, floor(0.5, 0));
  ASSERT_TRUE(j.found) << "`found`: one touch of a ball always has an answer";
  EXPECT_NEAR(j.normal, 9, 1e-12) << "N s: (1 + 1/2) 2 kg 3 m/s";
  EXPECT_NEAR(j.along, 0, 1e-12) << "N s: without friction (mu is 0) nothing rubs";
  EXPECT_NEAR((body.velocity - Vec3(1, 0, 1.5)).norm(), 0, 1e-12)
      << "m/s, from (1, 0, 1.5): half of the speed upwards, and all of it along; got "
      << body.velocity.transpose();
}

TEST(Ex05Scrape, AFastBallSlides) {
  RigidBody body = ball({10, 0, -1});
  const Scrape j = scrape(body, floor(1, 0.25));
  ASSERT_TRUE(j.found) << "`found`: one touch of a ball always has an answer";
  EXPECT_NEAR(j.normal, 4, 1e-12) << "N s: (1 + 1) 2 kg 1 m/s";
  EXPECT_NEAR(j.along, -1, 1e-12) << "N s: friction brakes with mu times the normal impulse, 0.25 * 4";
  EXPECT_NEAR(body.velocity.x(), 9.5, 1e-12) << "m/s: 10, less what 1 N s does to 2 kg";
  EXPECT_NEAR(body.spin.y(), 2.5, 1e-12)
      << "rad/s: the floor pulls the lower side back, and the ball begins to roll: "
         "1/2 m times 1 N s over 0.2 kg m^2";
}

TEST(Ex05Scrape, ASlowBallIsMadeToRoll) {
  RigidBody body = ball({0.7, 0, -2});
  const Scrape j = scrape(body, floor(0, 0.4));
  ASSERT_TRUE(j.found) << "`found`: one touch of a ball always has an answer";
  EXPECT_NEAR(body.velocity.x(), 0.5, 1e-12) << "m/s: five sevenths of 0.7, as every solid ball";
  EXPECT_NEAR(body.velocity_at(Vec3::Zero()).norm(), 0, 1e-12) << "m/s: the touching point is at rest";
  EXPECT_LT(std::abs(j.along), 0.4 * j.normal) << "N s: it sticks, so friction is less than its bound";
}

TEST(Ex05Scrape, SpinIsBraked) {
  RigidBody body = ball({0, 0, -1}, {0, 8, 0});  // the lower side moves backwards
  const Scrape j = scrape(body, floor(0.5, 0.2));
  ASSERT_TRUE(j.found) << "`found`: one touch of a ball always has an answer";
  EXPECT_NEAR(j.along, 0.6, 1e-12) << "N s: 0.2 * 3, forwards, against the slip of the lower side";
  EXPECT_NEAR(body.velocity.x(), 0.3, 1e-12) << "m/s: what 0.6 N s does to 2 kg; spin has become speed";
}

TEST(Ex05Scrape, EachTangentHasItsOwnBound) {
  RigidBody body = ball({10, 0.1, -1});
  const Scrape j = scrape(body, floor(0, 0.3));
  ASSERT_TRUE(j.found) << "`found`: one touch of a ball always has an answer";
  EXPECT_NEAR(j.along, -0.6, 1e-12) << "N s: slides along, at the bound 0.3 * 2";
  EXPECT_NEAR(body.velocity_at(Vec3::Zero()).y(), 0, 1e-12)
      << "m/s: across it sticks, for there the bound is not reached";
}

TEST(Ex05Scrape, WhoSeparatesIsLeftAlone) {
  RigidBody body = ball({10, 0, 1}, {3, 2, 1});
  const Scrape j = scrape(body, floor(0.5, 0.5));
  EXPECT_TRUE(j.found) << "`found`: to do nothing is the answer";
  EXPECT_EQ(j.normal, 0) << "N s: it flies off, and floors do not pull";
  EXPECT_EQ((body.velocity - Vec3(10, 0, 1)).norm(), 0) << "m/s: nothing pushes, so nothing rubs";
  EXPECT_EQ((body.spin - Vec3(3, 2, 1)).norm(), 0) << "rad/s: nothing rubs, so it spins on";
}

// What the header demands of an impact of a body that was as `before`, and is now as `after`.
void expect_law(const RigidBody& before, const RigidBody& after, const Touch& touch, const Scrape& j) {
  const Vec3 n = touch.normal, v = before.velocity_at(touch.point), v_after = after.velocity_at(touch.point);
  const double speed = std::max(1.0, v.norm()), epsilon = touch.restitution;
  const double excess = v_after.dot(n) + epsilon * v.dot(n);
  ASSERT_GE(j.normal, 0) << "N s: a floor pushes, it does not pull";
  ASSERT_GE(excess, -1e-9 * speed)
      << "m/s: v+_n = " << v_after.dot(n) << ", epsilon v_n = " << epsilon * v.dot(n)
      << "; friction changes the normal velocity, and the normal impulse has to answer";
  if (j.normal > 0) {
    ASSERT_NEAR(excess, 0, 1e-9 * speed) << "m/s: it pushes, so it obeys Newton's law";
  }
  const Vec3 tangents[] = {touch.along, n.cross(touch.along)};
  const double impulses[] = {j.along, j.across};
  for (int k = 0; k < 2; ++k) {
    const double bound = touch.friction * j.normal, slip = v_after.dot(tangents[k]);
    ASSERT_LE(std::abs(impulses[k]), bound + 1e-9) << "N s: friction beyond mu times the normal impulse";
    if (std::abs(impulses[k]) < bound - 1e-8) {
      ASSERT_NEAR(slip, 0, 1e-8) << "m/s: friction is below its bound, so the point sticks";
    } else {
      ASSERT_LE(slip * impulses[k], 1e-8) << "W s: friction at its bound must brake";
    }
  }
}

TEST(Ex05Scrape, KeepsTheLawForBoxes) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const double epsilon = (trial % 3) * 0.5, mu = 0.1 * (trial % 6);
    Hit hit = random_hit(random, epsilon, mu);
    const RigidBody before = hit.body;
    const Scrape j = scrape(hit.body, hit.touch);
    ASSERT_TRUE(j.found) << "it was not found, for mu = " << mu << " (trial " << trial << ")";
    ASSERT_NO_FATAL_FAILURE(expect_law(before, hit.body, hit.touch, j)) << "trial " << trial;
  }
}

// Plates, rods and bricks, at corners, edges and sides: where friction changes the normal velocity most.
TEST(Ex05Scrape, IsFoundAnywhereOnABox) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  for (int trial = 0; trial < 3000; ++trial) {
    Hit hit = random_hit(random, 0.5 * (trial % 3), 0.5);
    const Vec3 size(std::pow(10, any(random)), std::pow(10, any(random)), std::pow(10, any(random)));  // m
    hit.body.set_mass(fc::box_mass(size, 1 / size.prod()));
    Vec3 place = vector();  // on the unit cube: moved to a side, an edge or a corner
    for (int k = 0; k <= trial % 4; ++k)
      if (k < 3) place[k] = place[k] < 0 ? -1 : 1;
    hit.touch.point = hit.body.position + hit.body.orientation * (0.5 * size.cwiseProduct(place));
    const RigidBody before = hit.body;
    const Scrape j = scrape(hit.body, hit.touch);
    ASSERT_TRUE(j.found) << "it was not found, for mu = 0.5 and a box of " << size.transpose()
                         << " m, hit at " << place.transpose()
                         << " of its half sides; do you give up too soon?";
    ASSERT_NO_FATAL_FAILURE(expect_law(before, hit.body, hit.touch, j)) << "trial " << trial;
  }
}

TEST(Ex05Scrape, TheImpulsesAreThoseThatTheBodyGot) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    Hit hit = random_hit(random, 0.5, 0.4);
    const RigidBody before = hit.body;
    const Scrape j = scrape(hit.body, hit.touch);
    const Vec3 n = hit.touch.normal;
    const Vec3 total = j.normal * n + j.along * hit.touch.along + j.across * n.cross(hit.touch.along);
    ASSERT_NEAR((hit.body.momentum() - before.momentum() - total).norm(), 0, 1e-12)
        << "kg m/s: the body's momentum changes by the impulses that are returned";
    const Vec3 moment = (hit.touch.point - before.position).cross(total);
    const Vec3 turned = hit.body.inertia_world() * (hit.body.spin - before.spin);
    ASSERT_NEAR((turned - moment).norm(), 0, 1e-12) << "kg m^2/s: angular momentum about the centre";
  }
}

TEST(Ex05Scrape, FrictionWithoutBounceTakesEnergy) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    Hit hit = random_hit(random, 0, 0.5);
    const double before = hit.body.kinetic_energy();
    scrape(hit.body, hit.touch);
    ASSERT_LE(hit.body.kinetic_energy(), before + 1e-9) << "J: with epsilon = 0 nothing gives energy";
  }
}

}  // namespace

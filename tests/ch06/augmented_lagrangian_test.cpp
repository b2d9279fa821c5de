// All contacts at once: the residual where sweeps take very long, and where contacts are redundant.
#include <gtest/gtest.h>

#include <random>

#include "ch06_friction/contact_sweeps.hpp"

namespace {

using fc::Vec3;

// Boxes of 1 kg and 1 m, one on the other; the last body is the floor. They fall with 0.1 m/s, and the top one goes aside.
std::vector<fc::RigidBody> tower(int boxes, double aside) {
  std::vector<fc::RigidBody> bodies(static_cast<std::size_t>(boxes) + 1);
  for (int i = 0; i < boxes; ++i) {
    fc::RigidBody& box = bodies[static_cast<std::size_t>(i)];
    fc::MassProperties mass;
    mass.mass = 1;
    mass.inertia = fc::Mat3::Identity() / 6;
    box.set_mass(mass);
    box.position = Vec3(0, 0, 0.5 + i);
    box.velocity = Vec3(i == boxes - 1 ? aside : 0, 0, -0.1);
  }
  return bodies;
}

// `corners` of them at each level, on a square.
void start(fc::friction::ContactSweeps& sweeps, const std::vector<fc::RigidBody>& bodies, int corners,
           double mu) {
  sweeps.start(bodies);
  const int boxes = static_cast<int>(bodies.size()) - 1;
  for (int level = 0; level < boxes; ++level)
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * M_PI * (k + 0.5) / corners;
      const Vec3 place(0.5 * std::cos(angle), 0.5 * std::sin(angle), level);
      sweeps.add({level == 0 ? boxes : level - 1, level, place, Vec3::UnitZ()}, mu, Vec3::Zero(),
                 Vec3::Zero());
    }
}

TEST(AugmentedLagrangian, SolvesATowerThatSweepsDoNot) {
  const auto bodies = tower(50, 0);
  fc::friction::ContactSweeps sweeps;
  start(sweeps, bodies, 4, 0.5);
  EXPECT_GT(sweeps.run(1000, 1e-14), 1e-4) << "a sweep carries the weight on by one box";
  start(sweeps, bodies, 4, 0.5);
  sweeps.run(20, 1e-14);
  EXPECT_LE(sweeps.run_together(40, 1e-12), 1e-8);
}

// Twelve corners, of which three would suffice.
TEST(AugmentedLagrangian, DoesNotMindRedundantContacts) {
  fc::friction::ContactSweeps sweeps;
  const auto bodies = tower(3, 0);
  start(sweeps, bodies, 12, 0.5);
  EXPECT_LE(sweeps.run_together(40, 1e-12), 1e-11);
  double weight = 0;
  for (int k = 0; k < 12; ++k) weight += sweeps.impulse(k).z();
  EXPECT_NEAR(weight, 0.3, 1e-10) << "N s: three bodies of 1 kg, stopped from 0.1 m/s";
}

// The top box is faster than friction can stop: µ of the normal impulse, against the slip.
TEST(AugmentedLagrangian, Slides) {
  for (const double mu : {0.0, 0.1, 0.5}) {
    fc::friction::ContactSweeps sweeps;
    const auto bodies = tower(1, 2);
    start(sweeps, bodies, 4, mu);
    EXPECT_LE(sweeps.run_together(60, 1e-12), 1e-11) << mu;
    double normal = 0, tangential = 0;
    for (int k = 0; k < 4; ++k) {
      normal += sweeps.impulse(k).z();
      tangential += sweeps.impulse(k).x();
    }
    EXPECT_NEAR(normal, 0.1, 1e-10) << mu;
    EXPECT_NEAR(tangential, -0.1 * mu, 1e-10) << mu;
  }
}

// Where contacts slide, the shifts need not settle: this is a method among others.
TEST(AugmentedLagrangian, SolvesNearlyAllRandomProblems) {
  int unsolved = 0;
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> some(-1, 1);
  for (int problem = 0; problem < 200; ++problem) {
    auto bodies = tower(1 + problem % 4, some(engine));
    for (std::size_t i = 0; i + 1 < bodies.size(); ++i) {
      bodies[i].velocity += 0.3 * Vec3(some(engine), some(engine), some(engine));
      bodies[i].spin = Vec3(some(engine), some(engine), some(engine));
    }
    fc::friction::ContactSweeps sweeps;
    start(sweeps, bodies, 4, 0.3 + 0.2 * some(engine));
    sweeps.run(40, 1e-14);
    unsolved += !(sweeps.run_together(60, 1e-12) <= 1e-9);
  }
  EXPECT_LE(unsolved, 2) << "of 200";
}

TEST(AugmentedLagrangian, HoldsTangents) {
  fc::friction::ContactSweeps sweeps;
  const auto bodies = tower(20, 0);
  start(sweeps, bodies, 4, 0.5);
  const std::vector<char> holds(80, 1);
  EXPECT_LE(sweeps.run_held_together(holds, 40, 1e-10), 1e-9);
}

}  // namespace

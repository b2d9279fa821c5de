// Exercise 5.4. Closed forms: a row of balls after one sweep, a stack after many. Then heaps at random,
// beside the same method on the matrix, and the exact answer.
#include "ex04_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/delassus.hpp"

namespace {

using fc::RigidBody;
using fc::Vec3;
using fc::exercises::apply;
using fc::exercises::effective_mass;
using fc::exercises::solve;
using fc::exercises::sweep;
using fc::lcp::Contact;
using Numbers = std::vector<double>;

struct Scene {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
  Numbers approach_limits, impulses;

  void add(const Contact& contact, double may = 0) {
    contacts.push_back(contact);
    approach_limits.push_back(may);
    impulses.push_back(0);
  }
  double sweep_once() { return sweep(bodies, contacts, approach_limits, impulses); }
  double energy() const {  // J
    double sum = 0;
    for (const RigidBody& body : bodies) sum += body.is_static() ? 0 : body.kinetic_energy();
    return sum;
  }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (const RigidBody& body : bodies) sum += body.momentum();
    return sum;
  }
  Vec3 angular_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (const RigidBody& body : bodies) sum += body.angular_momentum();
    return sum;
  }
};

RigidBody cube(const Vec3& position, const Vec3& velocity, double mass = 1) {
  RigidBody body;
  body.position = position;
  body.velocity = velocity;
  body.set_mass(fc::box_mass({1, 1, 1}, mass));
  return body;
}
// A floor, and bodies over each other that all come down with this speed; contact k is below body k + 1.
Scene stack(int count, double speed) {
  Scene scene;
  scene.bodies.emplace_back();
  for (int k = 1; k <= count; ++k) {
    scene.bodies.push_back(cube({0, 0, k - 0.5}, {0, 0, -speed}));
    scene.add({k - 1, k, {0, 0, k - 1.0}, Vec3::UnitZ()});
  }
  return scene;
}
// Boxes of random shapes and orientations, each with some contacts with those before; `floor`: body 0 is
// fixed.
Scene heap(unsigned seed, bool floor, bool allows) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  Scene scene;
  for (int k = 0; k < 8; ++k) {
    RigidBody body;
    body.position = Vec3(0, 0, k) + 0.3 * vector();
    if (k > 0 || !floor) {
      body.orientation = Eigen::AngleAxisd(3 * any(random), vector().normalized());
      body.set_mass(fc::box_mass(Vec3::Constant(1) + 0.6 * vector(), 1 + 0.7 * any(random)));
      body.velocity = vector() - Vec3(0, 0, 0.2 * k);
      body.spin = vector();
    }
    scene.bodies.push_back(body);
    for (int i = 0; k > 0 && i < 2; ++i)
      scene.add({k - 1 - (k > 1 && i == 1), k, body.position + 0.5 * vector() - Vec3(0, 0, 0.5),
                 (0.4 * vector() + Vec3::UnitZ()).normalized()},
                allows ? 0.3 * any(random) : 0);
  }
  return scene;
}

TEST(Ex04Sweep, EffectiveMasses) {
  Scene balls;
  balls.bodies = {RigidBody{}, cube({0, 0, 1}, Vec3::Zero(), 2), cube({0, 0, 2}, Vec3::Zero(), 6)};
  EXPECT_NEAR(effective_mass(balls.bodies, {0, 1, {0, 0, 0.5}, Vec3::UnitZ()}), 2, 1e-14)
      << "kg: the floor does not yield, the cube's centre is above the point";
  EXPECT_NEAR(effective_mass(balls.bodies, {1, 2, {0, 0, 1.5}, Vec3::UnitZ()}), 1.5, 1e-14)
      << "kg: 1 / (1/2 + 1/6): two that yield answer with less than either";
  // At a corner of a cube of 1 kg: 1/m + |r x n|^2 / I = 1 + (1/2) / (1/6) = 4 /kg.
  balls.bodies[1] = cube({0, 0, 1}, Vec3::Zero(), 1);
  EXPECT_NEAR(effective_mass(balls.bodies, {0, 1, {0.5, 0.5, 0.5}, Vec3::UnitZ()}), 0.25, 1e-14)
      << "kg: at a corner the cube turns away, and seems light";
}

TEST(Ex04Sweep, ABodyThatIsTurned) {
  // A bar along x, turned to lie along y; a point at its end, half a metre in y from the centre.
  Scene scene;
  scene.bodies = {RigidBody{}, cube({0, 0, 1}, Vec3::Zero())};
  RigidBody& bar = scene.bodies[1];
  bar.set_mass(fc::box_mass({1, 0.2, 0.2}, 25));  // 1 kg
  bar.orientation = Eigen::AngleAxisd(1.5707963267948966, Vec3::UnitZ());
  const double inertia = (1 + 0.04) / 12;  // kg m^2, across the bar
  const Contact end{0, 1, {0, 0.5, 0.9}, Vec3::UnitZ()};
  EXPECT_NEAR(effective_mass(scene.bodies, end), 1 / (1 + 0.25 / inertia), 1e-13)
      << "kg: about the axis across the bar, which is x in the world and y in its own axes";
  apply(scene.bodies, std::vector<Contact>{end}, Numbers{2});
  EXPECT_NEAR(bar.velocity.z(), 2, 1e-14) << "m/s: 2 N s on 1 kg";
  EXPECT_NEAR(bar.spin.x(), 0.5 * 2 / inertia, 1e-12) << "rad/s: r x j / I, about x in the world";
  EXPECT_NEAR(bar.spin.y(), 0, 1e-13) << "rad/s: the blow has no lever arm about the bar itself";
}

TEST(Ex04Sweep, ABodyThatLands) {
  Scene scene = stack(1, 3);
  scene.approach_limits[0] = 0.5;
  scene.bodies[1].set_mass(fc::box_mass({1, 1, 1}, 2));
  EXPECT_NEAR(scene.sweep_once(), 2.5, 1e-14) << "m/s: so much was too fast";
  EXPECT_NEAR(scene.bodies[1].velocity.z(), -0.5, 1e-14) << "m/s: it may close in with 0.5";
  EXPECT_NEAR(scene.impulses[0], 5, 1e-14) << "N s: 2 kg lose 2.5 m/s";
  EXPECT_NEAR(scene.sweep_once(), 0, 1e-14)
      << "m/s: one row is solved by one sweep, so a second changes nothing";
  scene.approach_limits[0] = -1;
  scene.sweep_once();
  EXPECT_NEAR(scene.bodies[1].velocity.z(), 1, 1e-14) << "m/s: now it must part with 1";
}

TEST(Ex04Sweep, WhatPartsIsLetGo) {
  Scene scene = stack(1, -2);
  EXPECT_EQ(scene.sweep_once(), 0) << "m/s: it parts, so its row changes nothing";
  EXPECT_EQ(scene.impulses[0], 0) << "N s: contacts do not pull";
  EXPECT_EQ(scene.bodies[1].velocity.z(), 2) << "m/s: what parts flies on";
}

TEST(Ex04Sweep, WhatWasTooMuchIsTakenBack) {
  Scene scene = stack(1, 2);
  scene.impulses[0] = 5;
  apply(scene.bodies, scene.contacts, scene.impulses);
  EXPECT_NEAR(scene.bodies[1].velocity.z(), 3, 1e-14) << "m/s: 5 N s on 1 kg that came with 2 m/s";
  scene.sweep_once();
  EXPECT_NEAR(scene.impulses[0], 2, 1e-14) << "N s: the sum must not be negative, a change of it may";
  EXPECT_NEAR(scene.bodies[1].velocity.z(), 0, 1e-14) << "m/s: 2 N s just stop it";
}

// From below, the floor stops body 1, which shares what body 2 brings, which shares what body 3 brings, ...
TEST(Ex04Sweep, ARowFromBelow) {
  constexpr int kCount = 20;
  Scene scene = stack(kCount, 1);
  scene.sweep_once();
  for (int k = 1; k <= kCount; ++k) {
    const double left = 1 - std::pow(0.5, std::min(k, kCount - 1));
    EXPECT_NEAR(scene.bodies[static_cast<std::size_t>(k)].velocity.z(), -left, 1e-14)
        << "m/s, body " << k
        << ": each contact halves the difference, and the next one changes its upper body";
    EXPECT_NEAR(scene.impulses[static_cast<std::size_t>(k) - 1], std::pow(0.5, k - 1), 1e-14)
        << "N s, contact " << k - 1 << ": half as much as the one below, which was served before";
  }
}

TEST(Ex04Sweep, ARowFromAbove) {
  constexpr int kCount = 6;
  Scene scene = stack(kCount, 1);
  std::reverse(scene.contacts.begin(), scene.contacts.end());
  for (int sweeps = 1; sweeps <= kCount; ++sweeps) {
    scene.sweep_once();
    for (int k = 1; k <= kCount; ++k)
      EXPECT_EQ(scene.bodies[static_cast<std::size_t>(k)].velocity.z() > -1, k <= sweeps)
          << "body " << k << ", sweep " << sweeps
          << ": the news that there is a floor goes up one body a sweep";
  }
}

TEST(Ex04Sweep, AStackCarriesItsWeight) {
  constexpr int kCount = 8;
  const double speed = 9.81 / 60;  // m/s, of one frame
  Scene scene = stack(kCount, speed);
  const int sweeps = solve(scene.bodies, scene.contacts, scene.approach_limits, scene.impulses, 1e-13, 5000);
  EXPECT_LT(sweeps, 5000) << "sweeps: a stack of eight is solved in some hundreds";
  EXPECT_GT(sweeps, kCount) << "sweeps: the last news has to come down again";
  for (int k = 0; k < kCount; ++k)
    EXPECT_NEAR(scene.impulses[static_cast<std::size_t>(k)], (kCount - k) * speed, 1e-10)
        << "N s, contact " << k << ": the weight of all above, for one frame";

  // Next frame, with these as a guess.
  for (RigidBody& body : scene.bodies)
    if (!body.is_static()) body.velocity.z() -= speed;
  EXPECT_EQ(solve(scene.bodies, scene.contacts, scene.approach_limits, scene.impulses, 1e-10, 5000), 1)
      << "sweeps: the guess is the answer, and one sweep sees that";
  for (const RigidBody& body : scene.bodies)
    EXPECT_NEAR(body.velocity.norm(), 0, 1e-10) << "m/s: the stack stands";
}

TEST(Ex04Sweep, CountsItsSweeps) {
  Scene scene = stack(8, 1);
  EXPECT_EQ(solve(scene.bodies, scene.contacts, scene.approach_limits, scene.impulses, 1e-12, 3), 3)
      << "sweeps: that was the limit";
  Scene apart = stack(8, 0);
  EXPECT_EQ(solve(apart.bodies, apart.contacts, apart.approach_limits, apart.impulses, 1e-12, 3), 1)
      << "sweeps: the first sees that there is nothing to do";
}

// The same in other words: z_i := max(0, z_i - (A z + b)_i / A_ii), row after row.
TEST(Ex04Sweep, AsOnTheMatrix) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    Scene scene = heap(seed, seed % 2 == 0, true);
    const fc::lcp::ImpactProblem problem = fc::lcp::assemble(scene.bodies, scene.contacts);
    const Eigen::Index n = problem.b.size();
    fc::VecX z = fc::VecX::Zero(n), b = problem.v_before;
    for (Eigen::Index i = 0; i < n; ++i) b[i] += scene.approach_limits[static_cast<std::size_t>(i)];
    for (int sweeps = 1; sweeps <= 10; ++sweeps) {
      double largest = 0;
      for (Eigen::Index i = 0; i < n; ++i) {
        const double before = z[i];
        z[i] = std::max(0.0, z[i] - (problem.A.row(i).dot(z) + b[i]) / problem.A(i, i));
        largest = std::max(largest, problem.A(i, i) * std::abs(z[i] - before));
      }
      const double change = scene.sweep_once();
      ASSERT_NEAR(change, largest, 1e-11)
          << "m/s, the largest change of sweep " << sweeps << " (seed " << seed << "), as on the matrix";
      for (Eigen::Index i = 0; i < n; ++i)
        ASSERT_NEAR(scene.impulses[static_cast<std::size_t>(i)], z[i], 1e-11)
            << "N s, contact " << i << ", seed " << seed << ", sweep " << sweeps;
    }
  }
}

TEST(Ex04Sweep, EndsAtTheExactAnswer) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    Scene scene = heap(seed, true, true);
    if (seed % 3 == 0) std::fill(scene.impulses.begin(), scene.impulses.end(), 0.7);
    const fc::lcp::ImpactProblem problem = fc::lcp::assemble(scene.bodies, scene.contacts);
    fc::VecX b = problem.v_before;
    for (Eigen::Index i = 0; i < b.size(); ++i) b[i] += scene.approach_limits[static_cast<std::size_t>(i)];
    const fc::lcp::LcpResult exact = fc::lcp::solve_dantzig({problem.A, b});
    ASSERT_EQ(exact.status, fc::lcp::Status::solved) << "seed " << seed << ", of the test itself";
    solve(scene.bodies, scene.contacts, scene.approach_limits, scene.impulses, 1e-13, 100'000);
    for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
      ASSERT_NEAR(fc::lcp::contact_velocity(scene.bodies, scene.contacts[i]) + scene.approach_limits[i],
                  exact.w[static_cast<Eigen::Index>(i)], 1e-8)
          << "m/s, contact " << i << ", seed " << seed
          << ": the velocities are unique, and Dantzig's method has them";
      ASSERT_GE(scene.impulses[i], 0) << "N s: contacts do not pull";
    }
  }
}

TEST(Ex04Sweep, NoSweepMakesEnergyOrMomentum) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    Scene scene = heap(seed, false, false);
    const Vec3 momentum = scene.momentum(), turning = scene.angular_momentum();
    double last = scene.energy();
    for (int sweeps = 1; sweeps <= 20; ++sweeps) {
      scene.sweep_once();
      ASSERT_LE(scene.energy(), last * (1 + 1e-13)) << "J, seed " << seed << ", sweep " << sweeps
                                                    << ": no row gives energy to what only may not close in";
      last = scene.energy();
    }
    ASSERT_LE((scene.momentum() - momentum).norm(), 1e-12) << "kg m/s: nobody pushes from outside";
    ASSERT_LE((scene.angular_momentum() - turning).norm(), 1e-12) << "kg m^2/s: one point for both bodies";
  }
}

}  // namespace

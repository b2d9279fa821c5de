// Exercise 6.3: the residual on paper, then sweeps on problems with known answers, on random ones, and on one that goes in circles.
#include "ex03_many_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace fc::exercises;
using fc::MatX;
using fc::Vec3;
using fc::VecX;

VecX vector(std::initializer_list<double> numbers) {
  VecX v(static_cast<Eigen::Index>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), v.data());
  return v;
}

Problem one_ball(const Vec3& q, double mu) {
  return {Vec3(0.5, 1.75, 1.75).asDiagonal().toDenseMatrix(), q, vector({mu})};
}

// The same on every machine: contacts of bodies with this number of degrees of freedom in all.
Problem random_problem(unsigned seed, int count, double mu, int freedoms) {
  std::mt19937_64 random(seed);
  const auto any = [&] { return 2 * static_cast<double>(random() >> 11) / 9007199254740992.0 - 1; };
  MatX J(3 * count, freedoms);
  for (Eigen::Index i = 0; i < J.size(); ++i) J.data()[i] = any();
  Problem problem{J * J.transpose() + 0.02 * MatX::Identity(3 * count, 3 * count), VecX(3 * count),
                  VecX::Constant(count, mu)};
  for (int i = 0; i < 3 * count; ++i) problem.b[i] = i % 3 == 0 ? -0.2 - std::abs(any()) : 2 * any();
  return problem;
}

// A block of 2 kg on feet at x = ±0.3 m, 0.5 m below its centre, moves along x in a plane; and gravity for a frame.
Problem block(double speed, double mu, double gravity_dt) {
  MatX J = MatX::Zero(6, 3);  // velocity along x, along z, spin about y
  const double arm[2] = {-0.3, 0.3};
  for (int i = 0; i < 2; ++i) {
    J.row(3 * i) << 0, 1, -arm[i];
    J.row(3 * i + 1) << 1, 0, -0.5;
  }
  const Vec3 inverse(1 / 2., 1 / 2., 1 / 0.25);
  MatX A = J * inverse.asDiagonal() * J.transpose();
  A(2, 2) = A(5, 5) = 1;  // nothing happens across
  return {A, J * Vec3(speed, -gravity_dt, 0), vector({mu, mu})};
}

TEST(Ex06ManyContacts, TheResidualOnPaper) {
  // r = 0, û = (-1 + 0.5 * 5, 3, 4): -û/s with s = 1.75 is below the cone's dual: (-1.5, -3, -4)/1.75 has
  // its nearest point of the cone at n = (-1.5 + 0.5 * 5)/(1 + 0.25)/1.75 = 0.8/1.75, of length n √1.25.
  EXPECT_NEAR(residual(one_ball({-1, 3, 4}, 0.5), VecX::Zero(3)), 0.8 * std::sqrt(1.25) / 4, 1e-14)
      << "nothing has been done: 0.8 √1.25 m/s are missing, of 4 m/s";
  EXPECT_NEAR(residual(one_ball({-1, 0, 0}, 0), VecX::Zero(3)), 1, 1e-14) << "all of the velocity is wrong";
  EXPECT_NEAR(residual(one_ball({-1, 0, 0}, 0.5), vector({1, 0, 0})), 0.5 / 1, 1e-14)
      << "half of what would be needed: u_N = -0.5";
  EXPECT_NEAR(residual(one_ball({1, 0, 0}, 0.5), vector({-1, 0, 0})), 1.75, 1e-14)
      << "a pull, of 1 N s: s times that";
  EXPECT_EQ(residual(one_ball({0, 0, 0}, 0.5), VecX::Zero(3)), 0) << "nothing moves";
  EXPECT_EQ(residual({MatX(0, 0), VecX(0), VecX(0)}, VecX(0)), 0) << "no contacts";
}

TEST(Ex06ManyContacts, AnswersHaveNone) {
  EXPECT_LE(residual(one_ball({1, 3, 4}, 0.5), VecX::Zero(3)), 0) << "it parts: open";
  EXPECT_LE(residual(one_ball({-2, 0.7, 0}, 0.5), vector({4, -0.4, 0})), 1e-15) << "stick";
  EXPECT_LE(residual(one_ball({-2, 3, -4}, 0.5), vector({4, -1.2, 1.6})), 1e-15) << "slip";
  EXPECT_GE(residual(one_ball({-2, 3, -4}, 0.5), vector({4, -1.6, 1.2})), 0.01) << "friction askew";
  EXPECT_GE(residual(one_ball({-2, 3, -4}, 0.5), vector({4, 1.2, -1.6})), 0.1) << "friction along the slip";
  EXPECT_GE(residual(one_ball({-2, 0.7, 0}, 0.5), vector({4, -2, 0})), 0.1)
      << "more friction than the slip needs";
}

TEST(Ex06ManyContacts, TheResidualHasNoUnits) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Problem problem = random_problem(seed, 3, 0.5, 6);
    const VecX r = 0.3 * random_problem(seed + 100, 3, 0.5, 6).b.cwiseAbs();
    const double expected = residual(problem, r);
    ASSERT_GT(expected, 0);
    for (const double k : {1e-6, 1e3, 1e9}) {
      EXPECT_NEAR(residual({k * problem.A, problem.b, problem.mu}, r / k), expected, 1e-12 * expected)
          << "all masses divided by " << k << ": the same error";
      EXPECT_NEAR(residual({problem.A, k * problem.b, problem.mu}, k * r), expected, 1e-12 * expected)
          << "all velocities times " << k << ": the same error";
    }
  }
}

TEST(Ex06ManyContacts, OneContactNeedsOneSweep) {
  const Result got = solve(one_ball({-2, 3, -4}, 0.5), 1e-12, 100);
  EXPECT_TRUE(got.solved);
  EXPECT_EQ(got.sweeps, 1) << "sweeps: it is solved by the first one, and seen right after it";
  EXPECT_LE((got.r - vector({4, -1.2, 1.6})).norm(), 1e-12) << "N s";
  EXPECT_EQ(solve(one_ball({1, 3, 4}, 0.5), 1e-12, 100).sweeps, 0)
      << "sweeps: nothing is to be done, and that is seen at once";
}

TEST(Ex06ManyContacts, ABlockBrakes) {
  // Friction loads the front foot: N = ½ m g (1 ± mu H / b), b = 0.6 m between the feet, H = 1 m high. Both slide.
  const double mu = 0.4, weight = 2 * 9.81 / 60;
  const Result got = solve(block(5, mu, 9.81 / 60), 1e-13, 1000);
  ASSERT_TRUE(got.solved) << "residual " << got.residual;
  const double tilt = mu * 0.5 / 0.3;
  EXPECT_NEAR(got.r[0], 0.5 * weight * (1 - tilt), 1e-11) << "N s: the rear foot";
  EXPECT_NEAR(got.r[3], 0.5 * weight * (1 + tilt), 1e-11) << "N s: the front foot";
  EXPECT_NEAR(got.r[1] + got.r[4], -mu * weight, 1e-11) << "N s: friction of both";
  const Result tips = solve(block(5, 0.7, 9.81 / 60), 1e-13, 1000);
  ASSERT_TRUE(tips.solved) << "residual " << tips.residual;
  EXPECT_NEAR(tips.r[0], 0, 1e-13) << "N s: with mu > 0.6 the rear foot leaves the floor";
}

TEST(Ex06ManyContacts, RandomProblems) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const int count = 1 + static_cast<int>(seed % 5);
    const Problem problem = random_problem(seed, count, 0.3, 12);
    const Result got = solve(problem, 1e-10, 2000);
    ASSERT_TRUE(got.solved) << "seed " << seed << ", " << count << " contacts: residual " << got.residual
                            << " after " << got.sweeps;
    ASSERT_LE(residual(problem, got.r), 1e-10) << "seed " << seed;
    // The law itself, contact by contact.
    const VecX u = problem.A * got.r + problem.b;
    for (int i = 0; i < count; ++i) {
      const double normal = got.r[3 * i], friction = got.r.segment<2>(3 * i + 1).norm();
      ASSERT_GE(u[3 * i], -1e-8) << "m/s, seed " << seed << ", contact " << i << ": closes in";
      ASSERT_LE(friction, 0.3 * normal + 1e-8)
          << "N s, seed " << seed << ", contact " << i << ": outside of the cone";
      ASSERT_LE((0.3 * normal - friction) * u.segment<2>(3 * i + 1).norm(), 1e-7)
          << "N s m/s, seed " << seed << ", contact " << i << ": slips below the limit of friction";
    }
  }
}

TEST(Ex06ManyContacts, WhatGoesInCirclesIsRelaxed) {
  const Problem problem = random_problem(77, 3, 1, 6);
  const Result got = solve(problem, 1e-10, 2000);
  EXPECT_TRUE(got.solved) << "three contacts with mu = 1: plain sweeps go in circles for ever; residual "
                          << got.residual;
  EXPECT_LT(got.relaxation, 1) << "ω: halved when 50 sweeps have brought nothing";
  EXPECT_GE(got.relaxation, 1. / 16) << "ω";
  EXPECT_EQ(solve(random_problem(1, 3, 0.3, 12), 1e-10, 2000).relaxation, 1)
      << "ω: what goes well is left alone";
}

TEST(Ex06ManyContacts, WhatIsNotSolvedIsTold) {
  const Problem problem = random_problem(77, 3, 1, 6);
  for (const int most : {0, 1, 7}) {
    const Result got = solve(problem, 1e-12, most);
    EXPECT_FALSE(got.solved) << "after " << most << " sweeps";
    EXPECT_EQ(got.sweeps, most) << "sweeps";
    EXPECT_NEAR(got.residual, residual(problem, got.r), 1e-15)
        << "the residual is that of the impulses that are returned";
    EXPECT_GT(got.residual, 1e-12);
  }
}

TEST(Ex06ManyContacts, SweepsGoForwardsAndBackwards) {
  // Four contacts; the same by hand.
  const Problem problem = random_problem(5, 4, 0.5, 12);
  VecX r = VecX::Zero(12);
  for (int sweep = 0; sweep < 4; ++sweep) {
    for (int k = 0; k < 4; ++k) {
      const int i = sweep % 2 == 0 ? k : 3 - k;
      VecX others = r;
      others.segment<3>(3 * i).setZero();
      const Vec3 q = (problem.A * others + problem.b).segment<3>(3 * i);
      r.segment<3>(3 * i) = one_contact(problem.A.block<3, 3>(3 * i, 3 * i), q, 0.5);
    }
    EXPECT_LE((solve(problem, 0, sweep + 1).r - r).norm(), 1e-12) << "N s, after sweep " << sweep + 1;
  }
}

TEST(Ex06ManyContacts, WhatFrictionTakes) {
  const double mu = 0.4, weight = 2 * 9.81 / 60;
  const Problem brakes = block(5, mu, 9.81 / 60);
  EXPECT_NEAR(heat(brakes, solve(brakes, 1e-13, 1000).r), mu * weight * (5 - mu * 9.81 / 60), 1e-11)
      << "J: friction times the speed that is left";
  EXPECT_NEAR(heat(one_ball({-2, 0.7, 0}, 0.5), vector({4, -0.4, 0})), 0, 1e-15)
      << "J: what sticks makes no heat";
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Problem problem = random_problem(seed, 1 + static_cast<int>(seed % 5), 0.4, 12);
    const Result got = solve(problem, 1e-13, 5000);
    const VecX u = problem.A * got.r + problem.b;
    const double change = 0.5 * got.r.dot(u + problem.b), lost = heat(problem, got.r);
    ASSERT_GE(lost, -1e-12) << "J, seed " << seed;
    ASSERT_NEAR(change, -0.5 * got.r.dot(problem.A * got.r) - lost, 1e-9 * std::abs(got.r.dot(problem.b)))
        << "J, seed " << seed << ": what the impulses do to the energy";
  }
}

}  // namespace

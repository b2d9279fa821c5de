// Exercise 6.1: against closed forms, and against the law itself on random problems.
#include "ex01_one_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

namespace {

using namespace fc::mine;
using fc::Mat3;
using fc::Vec3;

std::string name(Kind kind) {
  return kind == Kind::open ? "open" : kind == Kind::stick ? "stick" : "slip";
}

Mat3 matrix(double a, double c1, double c2, double d11, double d12, double d22) {
  Mat3 A;
  A << a, c1, c2, c1, d11, d12, c2, d12, d22;
  return A;
}

// A ball of 2 kg on a floor: a tangent impulse turns it, too.
const Mat3 kBall = Vec3(0.5, 1.75, 1.75).asDiagonal();

// Painlevé's rod at tan θ = 2 in a plane, of which the third direction is a direction like any other.
const Mat3 kRod = matrix(1.6, -1.2, 0, 3.4, 0, 4);

void expect_answer(const Mat3& A, const Vec3& q, double mu, Kind kind, const Vec3& r,
                   const std::string& meaning) {
  const Answer got = solve_contact(A, q, mu);
  EXPECT_EQ(name(got.kind), name(kind)) << meaning;
  EXPECT_LE((got.r - r).norm(), 1e-12 * (1 + r.norm()))
      << "N s: r = (" << got.r.transpose() << "), expected (" << r.transpose() << "): " << meaning;
}

// By how much the law is violated, relative to the velocities that are added up.
double violation(const Mat3& A, const Vec3& q, double mu, const Answer& answer, std::string& what) {
  const Vec3 u = A * answer.r + q, parts = A.cwiseAbs() * answer.r.cwiseAbs() + q.cwiseAbs();
  const double size = parts.maxCoeff(), impulse = answer.r.norm();
  const double normal = answer.r[0], tangent = answer.r.tail<2>().norm(), slip = u.tail<2>().norm();
  double worst = 0;
  const auto look = [&](double broken, const char* rule) {
    if (!(broken <= worst)) {
      worst = broken;
      what = rule;
    }
  };
  if (size == 0) return 0;
  if (!answer.r.allFinite()) {
    what = "the impulse is finite";
    return std::numeric_limits<double>::infinity();
  }
  look(-u[0] / size, "nothing closes in");
  if (impulse > 0) look(-normal / impulse, "contacts push, and never pull");
  if (impulse > 0) look((tangent - mu * normal) / impulse, "|r_T| <= mu r_N");
  if (answer.kind == Kind::open) {
    look(impulse > 0 ? 1 : 0, "open: no impulse");
  } else {
    look(std::abs(u[0]) / size, "stick or slip: u_N = 0");
  }
  if (answer.kind == Kind::stick) look(slip / size, "stick: u_T = 0");
  if (answer.kind == Kind::slip) {
    if (impulse > 0) look(std::abs(tangent - mu * normal) / impulse, "slip: |r_T| = mu r_N");
    // The part of the slip that is not straight against r_T.
    if (tangent > 0) {
      const Eigen::Vector2d along = answer.r.tail<2>() / tangent;
      look(u.tail<2>().dot(along) / size, "slip: friction is against it");
      look((u.tail<2>() - u.tail<2>().dot(along) * along).norm() / size,
           "slip: friction is straight against it");
    }
  }
  return worst;
}

void expect_law(const Mat3& A, const Vec3& q, double mu, const std::string& where) {
  const Answer answer = solve_contact(A, q, mu);
  std::string what;
  const double broken = violation(A, q, mu, answer, what);
  ASSERT_LE(broken, 1e-12) << "of the velocities, " << where << ", " << name(answer.kind) << ": " << what
                           << "\nmu = " << mu << ", q = (" << q.transpose() << "), r = ("
                           << answer.r.transpose() << "), A =\n"
                           << A;
}

Mat3 random_matrix(std::mt19937_64& random, double decades) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any(-1, 1);
  Mat3 J;
  for (int i = 0; i < 9; ++i) J.data()[i] = normal(random);
  for (int i = 0; i < 3; ++i) J.col(i) *= std::pow(10, 0.5 * decades * any(random));
  return J * J.transpose();
}

Vec3 random_velocity(std::mt19937_64& random, double sideways) {
  std::normal_distribution<double> normal;
  const double closing = -std::abs(normal(random));
  return {closing, sideways * normal(random), sideways * normal(random)};
}

TEST(Ex06OneContact, WhatPartsIsOpen) {
  expect_answer(kBall, {1, 2, 3}, 0.5, Kind::open, Vec3::Zero(), "it parts");
  expect_answer(kBall, {0, 2, 3}, 0.5, Kind::open, Vec3::Zero(), "it slides along without being pressed on");
  expect_answer(Mat3::Zero(), {-1, 2, 3}, 0.5, Kind::open, Vec3::Zero(),
                "no impulse moves anything: then none is given");
}

TEST(Ex06OneContact, ABallSticksOrSlides) {
  // 7/2 mu |q_N| is the largest slip that friction stops.
  expect_answer(kBall, {-2, 0.3, -0.4}, 0.5, Kind::stick, {4, -0.3 / 1.75, 0.4 / 1.75},
                "0.5 m/s of slip is stopped: the limit is 3.5");
  expect_answer(kBall, {-2, 3, -4}, 0.5, Kind::slip, {4, -1.2, 1.6},
                "5 m/s of slip is not: mu r_N, straight against it");
  const double limit = 3.5;  // m/s
  EXPECT_EQ(name(solve_contact(kBall, {-2, limit * (1 - 1e-9), 0}, 0.5).kind), "stick")
      << "just inside the cone";
  EXPECT_EQ(name(solve_contact(kBall, {-2, limit * (1 + 1e-9), 0}, 0.5).kind), "slip")
      << "just outside of it";
}

TEST(Ex06OneContact, NoFriction) {
  const Mat3 A = matrix(2, 0.5, -1, 3, 0.25, 4);
  expect_answer(A, {-3, 1, 2}, 0, Kind::slip, {1.5, 0, 0}, "the normal impulse alone");
  expect_answer(kBall, {-3, 0, 0}, 0, Kind::stick, {6, 0, 0},
                "and where nothing slips, it sticks without any friction");
}

// In a plane the slip is to one side or to the other, and r_N = -β/(a ± µ c).
TEST(Ex06OneContact, TheNormalImpulseKnowsOfTheFriction) {
  const Mat3 A = matrix(2, -0.8, 0, 3, 0, 5);
  const double mu = 0.25;
  expect_answer(
      A, {-1, 6, 0}, mu, Kind::slip, {1 / (2 + 0.8 * mu), -mu / (2 + 0.8 * mu), 0},
      "slides to +: friction to -, which turns the contact down and is less to be stopped with r_N");
  expect_answer(A, {-1, -6, 0}, mu, Kind::slip, {1 / (2 - 0.8 * mu), mu / (2 - 0.8 * mu), 0},
                "slides to -: friction turns the contact into the floor, and the floor pushes more");
}

TEST(Ex06OneContact, PainlevesRodStopsDead) {
  const double det = 1.6 * 3.4 - 1.2 * 1.2;
  const auto stopping = [&](double n, double t) {
    return Vec3(-(3.4 * n + 1.2 * t) / det, -(1.2 * n + 1.6 * t) / det, 0);
  };
  expect_answer(
      kRod, {-0.01, -1, 0}, 1.5, Kind::stick, stopping(-0.01, -1),
      "impact without collision: the approach is slow, the impulse is large, and the rod stops dead");
  expect_answer(kRod, {-1e-9, -1, 0}, 1.5, Kind::stick, stopping(-1e-9, -1), "however slow the approach is");
  const double r = 0.01 / (1.6 + 1.2 * 1.5);
  expect_answer(kRod, {-0.01, 1, 0}, 1.5, Kind::slip, {r, -1.5 * r, 0}, "dragged the other way it slips");
  const double below = 0.01 / (1.6 - 1.2 * 1.3);
  expect_answer(kRod, {-0.01, -1, 0}, 1.3, Kind::slip, {below, 1.3 * below, 0}, "below mu = 4/3 it slips");
}

TEST(Ex06OneContact, OpenGoesBeforeStickAndStickBeforeSlip) {
  expect_answer(
      kRod, {0.01, -1, 0}, 1.5, Kind::open, Vec3::Zero(),
      "three answers: open; stick with r = (0.2915, 0.397); slip with r = (0.05, 0.075). It parts: open");
  // It sticks; but α = 0.76 and α = 6.1 solve the equation of slip, too.
  const Mat3 A = matrix(3.5, 3.8, 1.3, 5.1, 1.1, 0.7);
  const Vec3 q(-1, -3.6, 3.7);
  expect_answer(A, q, 4.3, Kind::stick, -A.inverse() * q,
                "an impulse in the cone stops it: then that is the answer, whatever else there is");
}

// Three slips, and no stick. |u_T| = α |r_T| with α = 0.122, 0.940 or 2.456.
TEST(Ex06OneContact, OfSeveralSlipsTheSlowest) {
  const Mat3 A = matrix(5.8, 0.8, 3.6, 3.5, -1.1, 3.1);
  const Vec3 q(-1, 3.3, -0.6);
  const Answer got = solve_contact(A, q, 1.6);
  EXPECT_EQ(name(got.kind), "slip");
  const Vec3 u = A * got.r + q;
  EXPECT_NEAR(u.tail<2>().norm() / got.r.tail<2>().norm(), 0.122, 1e-3)
      << "1/kg, α: three slips fulfil the law, with 0.122, 0.940 and 2.456; the slowest is wanted";
  expect_law(A, q, 1.6, "three slips");
}

TEST(Ex06OneContact, ADeadDirection) {
  const Mat3 rail = matrix(1, 0.5, 0, 2, 0, 0);  // nothing moves along the second tangent
  expect_law(rail, {-1, 0.2, 0}, 0.5, "a body on a rail, at rest along the dead direction");
  expect_answer(rail, {-1, -0.5, 0}, 0.5, Kind::stick, {1, 0, 0}, "the normal impulse stops all");
  const double mu = 0.5, r = 1.0;
  expect_answer(Vec3(1, 2, 0).asDiagonal(), {-1, 0, 3}, mu, Kind::slip, {r, 0, -mu * r},
                "it is carried along the dead direction: friction tries in vain, at its limit");
  expect_answer(Vec3(1, 0, 0).asDiagonal(), {-1, 3, 4}, mu, Kind::slip, {1, -0.3, -0.4}, "both are dead");
  expect_answer(Vec3(1, 0, 0).asDiagonal(), {-1, 0, 0}, mu, Kind::stick, {1, 0, 0},
                "both are dead, and nothing slips");
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(0, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const double angle = 2 * std::numbers::pi * any(random);
    Mat3 turn = Mat3::Identity();
    turn.block<2, 2>(1, 1) = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Vec3 q = random_velocity(random, 2);
    ASSERT_NO_FATAL_FAILURE(expect_law(turn * rail * turn.transpose(), q, 3 * any(random),
                                       "a rail askew, trial " + std::to_string(trial)));
  }
}

TEST(Ex06OneContact, RandomProblemsKeepTheLaw) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(0, 1);
  int sticks = 0, slips = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Mat3 A = random_matrix(random, trial % 3);
    const Vec3 q = random_velocity(random, trial % 2 == 0 ? 1 : 5);
    const double mu = trial % 4 == 0   ? 5 * any(random)
                      : trial % 4 == 1 ? std::pow(10, -6 * any(random))
                                       : any(random);
    ASSERT_NO_FATAL_FAILURE(expect_law(A, q, mu, "trial " + std::to_string(trial)));
    const Kind kind = solve_contact(A, q, mu).kind;
    sticks += kind == Kind::stick;
    slips += kind == Kind::slip;
    ASSERT_NE(name(kind), "open") << "trial " << trial << ": it closes in";
    // If the answer of u = 0 is in the cone, it is the answer.
    const Vec3 stop = -A.inverse() * q;
    if (stop.tail<2>().norm() < 0.999 * mu * stop[0]) {
      ASSERT_EQ(name(kind), "stick") << "trial " << trial << ": it can stop";
    }
  }
  EXPECT_GT(sticks, 2000) << "of the test itself";
  EXPECT_GT(slips, 5000) << "of the test itself";
}

TEST(Ex06OneContact, MassRatiosOfAHundredMillion) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> any(0, 1);
  for (int trial = 0; trial < 4000; ++trial) {
    Mat3 A = random_matrix(random, 0) + 0.1 * Mat3::Identity();
    const double ratio = std::pow(10, 8 * (2 * any(random) - 1));
    if (trial % 2 == 0) {
      A *= ratio;  // light or heavy as a whole
    } else {
      const Vec3 stiff(1, std::sqrt(ratio), 1);  // heavy along one tangent
      A = stiff.asDiagonal() * A * stiff.asDiagonal();
    }
    ASSERT_NO_FATAL_FAILURE(
        expect_law(A, random_velocity(random, 3), 2 * any(random), "ratio " + std::to_string(ratio)));
  }
}

TEST(Ex06OneContact, TurnedTangentsTurnTheAnswer) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const Mat3 A = random_matrix(random, 0) + 0.2 * Mat3::Identity();
    const Vec3 q = random_velocity(random, 4);
    const double mu = 0.6 * any(random);
    const Vec3 r = solve_contact(A, q, mu).r;
    for (const double degrees : {10.0, 45.0, 90.0, 217.0}) {
      Mat3 turn = Mat3::Identity();
      turn.block<2, 2>(1, 1) = Eigen::Rotation2Dd(degrees * std::numbers::pi / 180).toRotationMatrix();
      const Vec3 turned = solve_contact(turn * A * turn.transpose(), turn * q, mu).r;
      ASSERT_LE((turned - turn * r).norm(), 1e-10 * r.norm())
          << "N s, trial " << trial << ", tangents turned by " << degrees << " degrees: ("
          << turned.transpose() << ") is not (" << r.transpose()
          << "), turned. The floor does not know which tangents describe it";
    }
  }
}

// With e = 0: ½ r·(u + q) = -½ r·A r - µ r_N |u_T|.
TEST(Ex06OneContact, WhatFrictionTakes) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(0, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Mat3 A = random_matrix(random, 0) + 0.1 * Mat3::Identity();
    const Vec3 q = random_velocity(random, 4);
    const double mu = 2 * any(random);
    const Vec3 r = solve_contact(A, q, mu).r, u = A * r + q;
    ASSERT_GT(r.norm(), 0) << "trial " << trial << ": it closes in, something must push";
    const double change = 0.5 * r.dot(u + q), slip = mu * r[0] * u.tail<2>().norm();
    ASSERT_NEAR(change, -0.5 * r.dot(A * r) - slip, 1e-11 * (std::abs(r.dot(q)) + r.dot(A * r)))
        << "J, trial " << trial << ": what the impulse does to the energy. Heat of slip is " << slip << " J";
  }
}

TEST(Ex06OneContact, WhatIsNoNumberIsRefused) {
  const double nan = std::nan("");
  EXPECT_THROW(solve_contact(kBall, {-1, 0, 0}, -0.1), std::invalid_argument) << "negative friction drives";
  EXPECT_THROW(solve_contact(kBall, {-1, 0, 0}, std::numeric_limits<double>::infinity()),
               std::invalid_argument);
  EXPECT_THROW(solve_contact(kBall, {nan, 0, 0}, 0.1), std::invalid_argument);
  EXPECT_THROW(solve_contact(nan * kBall, {-1, 0, 0}, 0.1), std::invalid_argument);
}

}  // namespace

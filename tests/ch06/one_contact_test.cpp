// One contact: closed forms, all answers by sampling, degenerate blocks, symmetries.
#include "ch06_friction/one_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cones.hpp"

namespace fc::friction {
namespace {

// The scale-free residual of one contact.
double residual_of(const Mat3& A, const Vec3& q, double mu, const Vec3& r) {
  const MatX matrix = A;
  const VecX b = q, coefficient = VecX::Constant(1, mu), impulse = r;
  const VecX u = A * r + q;
  return residual({matrix, b, coefficient}, impulse, u);
}

// A block of mass m that touches a plane at its centre of mass: nothing couples.
TEST(OneContact, ABlockOnAnInclineSticksIfTheSlopeIsLessThanMu) {
  const double dt = 0.01, g = 9.81, m = 3;
  for (const double slope : {0.1, 0.5, 1.7}) {
    for (const double share : {0.5, 1 - 1e-6, 1 + 1e-6, 2.0}) {
      const double mu = share * slope, cosine = 1 / std::sqrt(1 + slope * slope), sine = slope * cosine;
      const Mat3 A = Mat3::Identity() / m;
      const Vec3 q(-g * dt * cosine, 0.6 * g * dt * sine,
                   0.8 * g * dt * sine);  // gravity's kick, down the slope
      const Vec3 r = OneContact(A, mu).solve(q), u = A * r + q;
      EXPECT_NEAR(r[0], m * g * dt * cosine, 1e-15);
      const double speed = share > 1 ? 0 : g * dt * (sine - mu * cosine);
      EXPECT_NEAR(u[1], 0.6 * speed, 1e-15);
      EXPECT_NEAR(u[2], 0.8 * speed, 1e-15);
    }
  }
}

// R22 of the notes: a ball that bounces without restitution while it slides, k² = 2/5.
TEST(OneContact, ABallSlidesOrRollsAfterAnImpact) {
  const double m = 2, mu = 0.2;
  const Mat3 A = Vec3(1 / m, 3.5 / m, 3.5 / m).asDiagonal();
  for (const double slip : {0.1, 0.6, 0.8, 3.0}) {
    const Vec3 q(-1, slip, 0), u = A * OneContact(A, mu).solve(q) + q;
    EXPECT_NEAR(u[0], 0, 1e-15);
    EXPECT_NEAR(u[1], std::max(0.0, slip - 3.5 * mu), 1e-15);
  }
}

TEST(OneContact, PainlevesRodStopsDeadAtAVanishingApproach) {
  const Mat3 A = painleve_block();
  const OneContact rod(A, 1.5);
  ASSERT_LT(A(0, 0) - 1.5 * std::abs(A(0, 1)), 0);
  const Vec3 r = rod.solve({-0.01, -1, 0}), u = A * r + Vec3(-0.01, -1, 0);
  EXPECT_NEAR(r[0], 1.234 / 4, 1e-14);  // stick, by Cramer's rule: det A = 4
  EXPECT_NEAR(r[1], 1.612 / 4, 1e-14);
  EXPECT_NEAR(u.norm(), 0, 1e-14);
  // The impulse does not shrink with the approach, hence not with the step.
  for (const double approach : {1e-3, 1e-6, 1e-9, 1e-12}) {
    EXPECT_NEAR(rod.solve({-approach, -1, 0})[0], 0.3, 1.1 * approach);
  }
}

TEST(OneContact, PainlevesRodOpensWhereItMay) {
  const Mat3 A = painleve_block();
  const Vec3 q(0.01, -1, 0);
  const auto answers = all_answers(A, q, 1.5, 1000);
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_NEAR((answers[1] - Vec3(0.2915, 0.397, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((answers[2] - Vec3(0.05, 0.075, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((A * answers[2] + q)[1], -0.805, 1e-12);
  EXPECT_EQ(OneContact(A, 1.5).solve(q), Vec3::Zero());  // open before stick before slip
}

TEST(OneContact, PainlevesRodSlidesWhereItIsDragged) {
  const Vec3 r = OneContact(painleve_block(), 1.5).solve({-0.01, 1, 0});
  EXPECT_NEAR(r[0], 0.01 / 3.4, 1e-15);
  EXPECT_NEAR(r[1], -0.015 / 3.4, 1e-15);
}

// A contact of uneven D̂ with a strong coupling: where answers are many.
OwnProblem uneven_contact(std::mt19937_64& random) {
  const auto decades = [&](double low, double high) { return std::pow(10.0, uniform(random, low, high)); };
  const double sign = uniform(random, -1, 1) < 0 ? -1 : 1;
  const Vec3 c(1, decades(-1, 1), sign * decades(-1, 1));
  const Mat3 delta = Vec3(0, decades(-3, 0), decades(0, 2)).asDiagonal();
  const Vec3 d(0, decades(-2, 1), uniform(random, -1, 1) * decades(-1, 1)), approach(-decades(-3, 0), 0, 0);
  return {delta + c * c.transpose(), approach[0] * c + d, VecX::Zero(1)};
}

// Open, then stick, then the least slip of all that there are.
TEST(OneContact, FindsThePreferredOfAllAnswers) {
  std::mt19937_64 random(20080101);
  int several = 0, least_of_slips = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    SCOPED_TRACE(draw);
    OwnProblem p = random_problem(random, 1, 3 + draw % 2, 0);
    if (draw % 2 == 1) p = uneven_contact(random);
    const Mat3 A = p.A;
    const Vec3 q = p.b;
    const double mu = std::pow(10.0, uniform(random, -2, 1.5));
    const Vec3 r = OneContact(A, mu).solve(q);
    EXPECT_LE(residual_of(A, q, mu, r), 1e-12);
    if (q[0] >= 0) {
      EXPECT_EQ(r, Vec3::Zero());
      continue;
    }
    const auto answers = all_answers(A, q, mu, 500);
    if (answers.size() > 1) ++several;
    if (answers.size() > 1 &&
        answers.front()[0] * mu < std::hypot(answers.front()[1], answers.front()[2]) * (1 + 1e-9))
      ++least_of_slips;
    ASSERT_FALSE(answers.empty());
    const double slip = (A * r + q).tail<2>().norm(), least = (A * answers.front() + q).tail<2>().norm();
    EXPECT_LE(slip, least + 1e-7 * q.norm());
  }
  EXPECT_GT(several, 100);
  EXPECT_GT(least_of_slips, 5);
}

TEST(OneContact, HasAnAnswerForEveryMu) {
  std::mt19937_64 random(20080102);
  for (int draw = 0; draw < 2000; ++draw) {
    const OwnProblem p = random_problem(random, 1, 4, 0);
    const Mat3 A = p.A;
    const Vec3 q = p.b;
    for (const double mu : {0.0, 1e-12, 1e-6, 1e3, 1e6}) {
      const Vec3 r = OneContact(A, mu).solve(q);
      ASSERT_TRUE(r.allFinite());
      EXPECT_LE(residual_of(A, q, mu, r), 1e-13 * (1 + mu)) << mu;
    }
  }
}

TEST(OneContact, KeepsItsDigitsOverEightDecadesOfMass) {
  std::mt19937_64 random(20080103);
  for (int draw = 0; draw < 5000; ++draw) {
    SCOPED_TRACE(draw);
    const OwnProblem p = random_problem(random, 1, 6, 0, 8);
    const Mat3 A = p.A;
    const Vec3 q = p.b;
    const double mu = uniform(random, 0, 2);
    EXPECT_LE(residual_of(A, q, mu, OneContact(A, mu).solve(q)), 1e-12);
  }
}

// A body that cannot move along tangent 2, along neither tangent, or not at all.
TEST(OneContact, NeedsNoCaseForDeadDirections) {
  std::mt19937_64 random(20080104);
  for (int draw = 0; draw < 3000; ++draw) {
    SCOPED_TRACE(draw);
    const int freedom = draw % 3;
    const OwnProblem p = random_problem(random, 1, freedom, 0);
    const Mat3 A = p.A;
    const Vec3 q = p.b;
    const double mu = uniform(random, 0, 1);
    const Vec3 r = OneContact(A, mu).solve(q);
    ASSERT_TRUE(r.allFinite());
    EXPECT_LE(residual_of(A, q, mu, r), 1e-12);
    // A slip that no impulse changes, as of a belt under what is locked along it.
    const Mat3 locked = Vec3(1, 1, 0).asDiagonal();
    const Vec3 belt(-1, 0, 0.5), f = OneContact(locked, mu).solve(belt);
    EXPECT_NEAR(f[2], -mu, 1e-15);
    EXPECT_LE(residual_of(locked, belt, mu, f), 1e-15);
  }
  EXPECT_EQ(OneContact(Mat3::Zero(), 0.5).solve({-1, 1, 0}), Vec3::Zero());
}

// Which tangent is the first, and where they point, does not matter; nor do units.
TEST(OneContact, TurnsMirrorsAndScales) {
  std::mt19937_64 random(20080105);
  for (int draw = 0; draw < 2000; ++draw) {
    SCOPED_TRACE(draw);
    const OwnProblem p = random_problem(random, 1, 3, 0);
    const Mat3 A = p.A;
    const Vec3 q = p.b;
    const double mu = uniform(random, 0, 2), size = p.A.norm();
    const Vec3 r = OneContact(A, mu).solve(q);
    const Mat3 swap{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, mirror = Vec3(1, -1, 1).asDiagonal();
    const Mat3 turn = Eigen::AngleAxisd(uniform(random, 0, 6), Vec3::UnitX()).toRotationMatrix();
    for (const Mat3& T : {swap, mirror, turn}) {
      const Vec3 image = OneContact(T * A * T.transpose(), mu).solve(T * q);
      EXPECT_LE((image - T * r).norm() * size, 1e-9 * (q.norm() + r.norm() * size));
    }
    const Vec3 scaled = OneContact(A * 0x1p-30, mu).solve(q * 0x1p20);
    EXPECT_LE((scaled * 0x1p-50 - r).norm() * size, 1e-12 * (q.norm() + r.norm() * size));
  }
}

}  // namespace
}  // namespace fc::friction

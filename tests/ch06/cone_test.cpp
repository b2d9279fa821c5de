// The cone, the residual, and what may be called solved.
#include "ch06_friction/cone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "cones.hpp"

namespace fc::friction {
namespace {

// The nearest point p of K is the one with p ∈ K, p - x ∈ K* and p ⟂ p - x (Moreau).
TEST(Cone, ProjectsOntoTheNearestPoint) {
  std::mt19937_64 random(20080101);
  for (int draw = 0; draw < 10000; ++draw) {
    const Vec3 x(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    const double mu = std::pow(10.0, uniform(random, -3, 3));
    const Vec3 p = project_onto_cone(x, mu), away = p - x;
    EXPECT_GE(mu * p[0] - p.tail<2>().norm(), -1e-15);
    EXPECT_GE(away[0] - mu * away.tail<2>().norm(), -1e-15 * (1 + mu));
    EXPECT_NEAR(p.dot(away), 0, 1e-15);
  }
}

TEST(Cone, IsAHalfLineWithoutFriction) {
  EXPECT_EQ(project_onto_cone({2, 3, -1}, 0), Vec3(2, 0, 0));
  EXPECT_EQ(project_onto_cone({-2, 3, -1}, 0), Vec3::Zero());
  EXPECT_EQ(project_onto_cone({0, 0, 0}, 0.5), Vec3::Zero());
  EXPECT_EQ(de_saxce({1, 3, 4}, 0.5), Vec3(3.5, 3, 4));
}

// Violations by hand, with a scale of 2 1/kg and µ = 1/2.
TEST(Cone, ViolationIsZeroExactlyForTheLaw) {
  const auto violation = [](const Vec3& r, const Vec3& u) { return cone_violation(r, u, 0.5, 2); };
  EXPECT_EQ(violation({0, 0, 0}, {1, 7, 0}), 0);                  // open
  EXPECT_EQ(violation({1, 0.3, 0.4}, {0, 0, 0}), 0);              // stick
  EXPECT_NEAR(violation({2, 1, 0}, {0, -3, 0}), 0, 1e-15);        // slip
  EXPECT_NEAR(violation({1, 0, 0}, {0.25, 0, 0}), 0.25, 1e-15);   // pushes what leaves
  EXPECT_NEAR(violation({0, 0, 0}, {-0.25, 0, 0}), 0.25, 1e-15);  // lets approach
  EXPECT_GT(violation({2, 0.5, 0}, {0, -3, 0}), 0.1);             // brakes less than it could
  EXPECT_GT(violation({2, 1, 0}, {0, 3, 0}), 0.1);                // drives
  EXPECT_GT(violation({2, 1, 0}, {0, 0, -3}), 0.1);               // at a right angle to the slip
  // Lifts what slides, as the convex relaxation of Anitescu does: u in K*.
  EXPECT_GT(violation({2, 1, 0}, {1.5, -3, 0}), 0.1);
}

TEST(ConeResidual, HasNoUnit) {
  std::mt19937_64 random(20080102);
  for (int draw = 0; draw < 200; ++draw) {
    const OwnProblem p = random_problem(random, 3, 6, 0.5);
    const VecX r = random_matrix(random, 9, 1), u = p.A * r + p.b;
    const double value = residual(p, r, u);
    const MatX A = 0x1p-40 * p.A;
    const VecX b = 0x1p10 * p.b, r_there = 0x1p50 * r, u_there = 0x1p10 * u;
    EXPECT_EQ(residual({A, b, p.mu}, r_there, u_there), value);
    EXPECT_GT(value, 0);
  }
}

TEST(ConeResidual, AgreesWithTheLawInWords) {
  std::mt19937_64 random(20080103);
  for (int draw = 0; draw < 1000; ++draw) {
    SCOPED_TRACE(draw);
    const OwnProblem p = random_problem(random, 1, 4, uniform(random, 0, 1.5));
    VecX r = random_matrix(random, 3, 1);
    r = project_onto_cone(r, p.mu[0]);
    const VecX u = p.A * r + p.b;
    const double in_words = broken_law(p, r, u) / size_of(p, r), ours = residual(p, r, u);
    // The same up to a factor: neither is small alone.
    EXPECT_LE(ours, 8 * in_words);
    EXPECT_LE(in_words, 8 * (1 + p.mu[0]) * ours);
  }
}

TEST(ConeProblem, PhysicalErrorsByHand) {
  const MatX A = MatX::Identity(6, 6);
  const VecX b = VecX::Constant(6, -1), mu{{0.5, 1.0}};
  const VecX r{{2, 0, 1.5, 1, 0.25, 0}}, u{{-0.125, 3, 0, 0, 0, -0.5}};
  const PhysicalErrors e = physical_errors({A, b, mu}, r, u);
  EXPECT_EQ(e.approach, 0.125);
  EXPECT_EQ(e.cone_excess, 0.5);
  EXPECT_EQ(e.creep, 0.5);
  EXPECT_NEAR(e.angle, std::acos(0.0), 1e-15);
}

TEST(ConeProblem, OnlyAnAnswerIsAcceptable) {
  const MatX A = MatX::Identity(3, 3);
  const VecX b{{-1, 1, 0}}, mu{{0.5}}, r{{1, -0.5, 0}};
  const ConeProblem p{A, b, mu};
  EXPECT_TRUE(acceptable(p, r, A * r + b));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const VecX& wrong :
       {VecX{{1, -0.5 - 1e-12, 0}}, VecX{{1, -0.499, 0}}, VecX{{1.001, -0.5, 0}}, VecX{{0, 0, 0}},
        VecX{{-1e-300, 0, 0}}, VecX{{nan, 0, 0}}, VecX{{1, nan, 0}}, VecX{{1, 0}}}) {
    const VecX u = wrong.size() == 3 ? VecX(A * wrong + b) : b;
    EXPECT_FALSE(acceptable(p, wrong, u)) << wrong.transpose();
  }
  EXPECT_FALSE(acceptable(p, r, VecX{{0, 0.5 + 1e-12, 0}}));  // not A r + b
  // A huge r makes any residual small, and u loses its digits.
  const MatX tiny = 1e-20 * MatX::Identity(3, 3);
  const VecX pushed{{1e20, 0, 0}}, start{{-1, 0, 0}};
  EXPECT_TRUE(acceptable({tiny, start, mu}, pushed, VecX::Zero(3)));
  const MatX singular = MatX::Ones(3, 3) * 1e4;
  EXPECT_FALSE(
      acceptable({singular, VecX{{-1e-12, 0, 0}}, mu}, VecX{{1e3, -5e2, -5e2}}, VecX{{-1e-12, 0, 0}}));
}

TEST(ConeProblem, RefusesCallersMistakes) {
  const MatX A = MatX::Identity(3, 3);
  const VecX b = VecX::Zero(3), mu = VecX::Ones(1), two = VecX::Ones(2);
  EXPECT_NO_THROW(check_arguments({A, b, mu}));
  EXPECT_THROW(check_arguments({A, b, two}), std::invalid_argument);
  EXPECT_THROW(check_arguments({A, two, mu}), std::invalid_argument);
  EXPECT_THROW(check_arguments({A.topRows(2), b, mu}), std::invalid_argument);
  EXPECT_THROW(check_arguments({A, b, -mu}), std::invalid_argument);
  EXPECT_THROW(check_arguments({A, b, std::numeric_limits<double>::infinity() * mu}), std::invalid_argument);
  EXPECT_THROW(check_arguments({A, std::numeric_limits<double>::quiet_NaN() * VecX::Ones(3), mu}),
               std::invalid_argument);
}

}  // namespace
}  // namespace fc::friction

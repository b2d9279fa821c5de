// The residual and the check that stands before the word "solved".
#include "ch03_impulse_lcp/problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp {
namespace {

const MatX kMatrix{{2, -1}, {-1, 2}};
const VecX kVector{{-2, 0}};
const VecX kSolution{{4.0 / 3, 2.0 / 3}};

TEST(Residual, IsTheContractsFormula) {
  // z = (1, 0): w = (0, -1), s = (2, 2); min(2, 0) = 0, min(0, -1) = -1; max|b| = 2, max(|A||z|) = 2.
  const VecX z{{1, 0}};
  EXPECT_DOUBLE_EQ(residual({kMatrix, kVector}, z, evaluate(kMatrix, kVector, z)), 0.5);
}

TEST(Residual, HasNoUnit) {
  const VecX z{{1, 0.25}};
  const double expected = residual({kMatrix, kVector}, z, evaluate(kMatrix, kVector, z));
  for (const double unit : {1e-6, 1e6}) {
    const MatX A = kMatrix * unit;
    EXPECT_NEAR(residual({A, kVector}, z / unit, evaluate(A, kVector, z / unit)), expected, 1e-15);
    EXPECT_NEAR(residual({kMatrix, kVector * unit}, z * unit, evaluate(kMatrix, kVector * unit, z * unit)),
                expected, 1e-15);
  }
}

TEST(Residual, OfNothingIsZero) {
  EXPECT_EQ(residual({MatX(0, 0), VecX(0)}, VecX(0), VecX(0)), 0);
  EXPECT_EQ(residual({MatX::Zero(1, 1), VecX::Zero(1)}, VecX::Zero(1), VecX::Zero(1)), 0);
}

TEST(Residual, DoesNotHideANaN) {
  const VecX z{{std::numeric_limits<double>::quiet_NaN(), 0}};
  EXPECT_TRUE(std::isnan(residual({kMatrix, kVector}, z, evaluate(kMatrix, kVector, z))));
  EXPECT_FALSE(acceptable({kMatrix, kVector}, z, evaluate(kMatrix, kVector, z)));
}

TEST(Acceptable, TakesTheSolution) {
  EXPECT_TRUE(acceptable({kMatrix, kVector}, kSolution, evaluate(kMatrix, kVector, kSolution)));
}

TEST(Acceptable, RefusesANegativeImpulse) {
  const MatX A{{1, 0}, {0, 1}};
  const VecX b{{0, -1}}, z{{-1e-300, 1}};
  EXPECT_FALSE(acceptable({A, b}, z, evaluate(A, b, z)));
}

TEST(Acceptable, RefusesANegativeVelocity) {
  const VecX z = kSolution * (1 - 1e-5);
  EXPECT_FALSE(acceptable({kMatrix, kVector}, z, evaluate(kMatrix, kVector, z)));
}

TEST(Acceptable, RefusesAVelocityThatIsNotThatOfTheImpulses) {
  EXPECT_FALSE(acceptable({kMatrix, kVector}, VecX::Zero(2), VecX::Zero(2)));
}

TEST(Acceptable, RefusesAnImpulseOnAZeroRowThatSeparates) {
  const MatX A = MatX::Zero(1, 1);
  const VecX b{{1}};
  EXPECT_TRUE(acceptable({A, b}, VecX::Zero(1), b));
  EXPECT_FALSE(acceptable({A, b}, VecX::Ones(1), b));
}

// A huge z makes the residual's denominator huge: |min| / (|A||z|) is then small although w lost all its
// digits.
TEST(Acceptable, IsNotBoughtByAHugeImpulse) {
  const MatX A{{1, -1}, {-1, 1}};
  const VecX b{{-1, -1}};  // no solution: the two rows add up to -2
  const VecX z = VecX::Constant(2, 1e13);
  const VecX w = evaluate(A, b, z);
  EXPECT_LT(residual({A, b}, z, w), 1e-12);
  EXPECT_FALSE(acceptable({A, b}, z, w));
}

TEST(Certificate, IsBelievedOnlyIfItProves) {
  const MatX A{{1, -1}, {-1, 1}};
  EXPECT_TRUE(certifies_no_solution({A, VecX{{-2, 1}}}, VecX{{1, 1}}));
  EXPECT_TRUE(certifies_no_solution({A * 1e-8, VecX{{-2e5, 1e5}}}, VecX{{3, 3}}));
  EXPECT_FALSE(certifies_no_solution({A, VecX{{-2, 2}}}, VecX{{1, 1}}));    // b'y = 0
  EXPECT_FALSE(certifies_no_solution({A, VecX{{-2, 1}}}, VecX{{1, 0}}));    // A'y > 0 somewhere
  EXPECT_FALSE(certifies_no_solution({A, VecX{{-2, 1}}}, VecX{{-1, -1}}));  // not y >= 0
  EXPECT_FALSE(certifies_no_solution({A, VecX{{-2, 1}}}, VecX{{0, 0}}));
}

// A row that is all zero may carry any z: nearly all of y may stand there without proving anything of the
// others.
TEST(Certificate, IsNotBoughtByAHugeEntryThatDoesNothing) {
  const MatX A{{18, 0}, {0, 0}};
  EXPECT_FALSE(certifies_no_solution({A, VecX{{-2, 0}}}, VecX{{1e-11, 1}}));
  EXPECT_EQ(solve({A, VecX{{-2, 0}}}, Method::interior_point).status, Status::solved);
}

TEST(Certificate, UsesOnlyWaysWithoutABound) {
  const MatX A{{0}};
  const VecX b{{-1}}, upper{{5}};
  EXPECT_TRUE(certifies_no_solution({A, b}, VecX{{1}}));
  EXPECT_FALSE(certifies_no_solution({A, b, nullptr, &upper}, VecX{{1}}));
}

TEST(CheckArguments, RefusesWhatIsNoProblem) {
  EXPECT_THROW(check_arguments({MatX::Zero(2, 3), VecX::Zero(2)}), std::invalid_argument);
  EXPECT_THROW(check_arguments({MatX::Zero(2, 2), VecX::Zero(3)}), std::invalid_argument);
  MatX A = MatX::Identity(2, 2);
  A(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check_arguments({A, VecX::Zero(2)}), std::invalid_argument);
  VecX b = VecX::Zero(2);
  b[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(check_arguments({MatX::Identity(2, 2), b}), std::invalid_argument);
}

}  // namespace
}  // namespace fc::lcp

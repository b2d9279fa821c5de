// Exercise 4.6.
#include "ex06_gap_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using fc::mine::GapScale;
using fc::mine::NextGap;

constexpr double kMicro = 1e-6;  // m
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Ex06GapRule, APairThatIsFarStopsAtHalfTheTolerance) {
  for (const double gap : {kInfinity, 1.0, 1e-3, 1.001 * kMicro, kMicro}) {
    const NextGap next = fc::mine::gap_rule(gap, {kMicro, 0.01 * kMicro, 1e-13});
    EXPECT_DOUBLE_EQ(next.target, 0.5 * kMicro)
        << "m, from a gap of " << gap << " m with a tolerance of 1e-6 m";
    EXPECT_FALSE(next.spent) << "a gap of " << gap << " m: all of it can still be spent";
  }
}

TEST(Ex06GapRule, WithinTheToleranceHalfOfTheGapMayBeSpent) {
  for (const double part : {0.9, 0.5, 0.25, 0.125, 0.02}) {
    const NextGap next = fc::mine::gap_rule(part * kMicro, {kMicro, 0.01 * kMicro, 1e-13});
    EXPECT_DOUBLE_EQ(next.target, 0.5 * part * kMicro)
        << "m, from a gap of " << part
        << " tolerances. A target that is not below the gap is reached at once, and the pair "
        << "never gets on";
    EXPECT_FALSE(next.spent) << "at " << part << " tolerances";
  }
}

TEST(Ex06GapRule, NoGapBecomesZero) {
  double gap = kMicro;
  for (int impact = 1; impact <= 200; ++impact) {
    const double target = fc::mine::gap_rule(gap, {kMicro, 0, 0}).target;
    ASSERT_GT(target, 0) << "m, at impact " << impact
                         << ": the bodies touch, and the next impact makes them overlap";
    ASSERT_LT(target, gap) << "m, at impact " << impact << ": no room to come back in";
    gap = target;
  }
}

TEST(Ex06GapRule, SevenImpactsOneUponTheOtherSpendTheGap) {
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const GapScale scale{tolerance, 0.01 * tolerance, 1e-16};
    double gap = kInfinity;
    int impacts = 0;
    while (!fc::mine::gap_rule(gap, scale).spent && impacts < 100) {
      gap = fc::mine::gap_rule(gap, scale).target;
      ++impacts;
    }
    EXPECT_EQ(impacts, 7) << "impacts until nothing is left, with a tolerance of " << tolerance
                          << " m: 1/2, 1/4, ... 1/128 of it; the last is below a hundredth";
  }
}

TEST(Ex06GapRule, TheLimitItselfIsLittle) {
  const GapScale scale{kMicro, 0.01 * kMicro, 1e-13};
  EXPECT_TRUE(fc::mine::gap_rule(scale.little, scale).spent)
      << "a gap of exactly scale.little: the limit counts";
  EXPECT_FALSE(fc::mine::gap_rule(1.001 * scale.little, scale).spent) << "a little more than scale.little";
}

TEST(Ex06GapRule, AGapOfRoundingAloneIsNotHalved) {
  const double rounding = 4e-12;  // m
  for (const double gap : {rounding, 0.5 * rounding, 0.0, -rounding}) {
    const NextGap next = fc::mine::gap_rule(gap, {kMicro, 0.01 * kMicro, rounding});
    EXPECT_DOUBLE_EQ(next.target, gap - rounding)
        << "m, from a gap of " << gap << " m that may be off by " << rounding << " m";
    EXPECT_TRUE(next.spent) << "a gap of " << gap << " m";
  }
}

TEST(Ex06GapRule, BodiesFarFromTheOriginHaveMoreRounding) {
  const double rounding = 3e-8;  // m, more than a hundredth of the tolerance
  EXPECT_TRUE(fc::mine::gap_rule(2e-8, {kMicro, 0.01 * kMicro, rounding}).spent)
      << "a gap of 2e-8 m is more than a hundredth of the tolerance, but it may be nothing but rounding (3e-8 m)";
  EXPECT_FALSE(fc::mine::gap_rule(4e-8, {kMicro, 0.01 * kMicro, rounding}).spent)
      << "a gap of 4e-8 m is more than rounding (3e-8 m), and more than a hundredth of the tolerance";
}

TEST(Ex06GapRule, FarMayBeMoreThanTheTolerance) {  // chapter 5 keeps bodies farther apart
  const GapScale scale{1e-4, 1e-8, 1e-13};
  EXPECT_DOUBLE_EQ(fc::mine::gap_rule(1, scale).target, 5e-5) << "m";
  EXPECT_DOUBLE_EQ(fc::mine::gap_rule(2e-5, scale).target, 1e-5) << "m";
  EXPECT_FALSE(fc::mine::gap_rule(2e-7, scale).spent)
      << "compare with scale.little, not with a part of scale.far";
}

TEST(Ex06GapRule, TheTargetIsAlwaysBelowTheGap) {
  std::mt19937_64 random(46);
  std::uniform_real_distribution<double> digits(-14, 0);
  for (int trial = 0; trial < 10'000; ++trial) {
    const double tolerance = std::pow(10, digits(random)), gap = std::pow(10, digits(random)),
                 rounding = std::pow(10, digits(random) - 4);
    const NextGap next = fc::mine::gap_rule(gap, {tolerance, 0.01 * tolerance, rounding});
    ASSERT_LT(next.target, gap) << "m; tolerance " << tolerance << " m, rounding " << rounding << " m";
    ASSERT_LE(next.target, 0.5 * tolerance) << "m; gap " << gap << " m, rounding " << rounding << " m";
    if (gap > rounding) {
      ASSERT_GT(next.target, 0) << "m; gap " << gap << " m, rounding " << rounding << " m";
    }
  }
}

}  // namespace

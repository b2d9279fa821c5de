// Dantzig's method on problems whose answer is known on paper, and on those that break naive versions.
#include "ch03_impulse_lcp/dantzig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace fc::lcp {
namespace {

constexpr double kRounding = 1e-14;  // a few units of round-off of numbers near 1

void expect_solution(const MatX& A, const VecX& b, const VecX& z) {
  const LcpResult result = solve_dantzig({A, b});
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_LE((result.z - z).lpNorm<Eigen::Infinity>(), kRounding) << "z = " << result.z.transpose();
  EXPECT_LE(result.residual, kRounding);
}

TEST(Dantzig, SolvesTheWorkedExampleOfTheText) {
  expect_solution(MatX{{2, -1}, {-1, 2}}, VecX{{-2, 0}}, VecX{{4. / 3, 2. / 3}});
}

TEST(Dantzig, TakesNoPivotIfNothingApproaches) {
  const LcpResult result = solve_dantzig({MatX{{2, -1}, {-1, 2}}, VecX{{0, 3}}});
  EXPECT_EQ(result.status, Status::solved);
  EXPECT_EQ(result.pivots, 0);
  EXPECT_TRUE(result.z.isZero(0));
}

TEST(Dantzig, SolvesNothing) {
  EXPECT_EQ(solve_dantzig({MatX(0, 0), VecX(0)}).status, Status::solved);
}

TEST(Dantzig, SolvesOneRow) {
  expect_solution(MatX{{4}}, VecX{{-2}}, VecX{{0.5}});
}

// Row 0 enters the basis first and has to leave it again while row 2 is driven.
TEST(Dantzig, LetsARowLeaveTheBasis) {
  const MatX A{{1, 0, 0.9}, {0, 1, 0.3}, {0.9, 0.3, 1}};
  const VecX b{{-1, -1, -3}};
  const LcpResult result = solve_dantzig({A, b});
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_EQ(result.z[0], 0);
  EXPECT_GT(result.w[0], 0.1);
  EXPECT_GT(result.pivots, 3);
  EXPECT_LE(result.residual, kRounding);
}

TEST(Dantzig, SolvesRedundantRows) {
  // Every row eight times: w is that of the single rows, z adds up to theirs.
  const MatX A{{2, -1}, {-1, 2}};
  const VecX b{{-2, 0}};
  MatX many(16, 16);
  VecX many_b(16);
  for (int i = 0; i < 16; ++i) {
    many_b[i] = b[i % 2];
    for (int j = 0; j < 16; ++j) many(i, j) = A(i % 2, j % 2);
  }
  const LcpResult result = solve_dantzig({many, many_b});
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_LE(result.residual, kRounding);
  double sum = 0;
  for (int i = 0; i < 16; i += 2) sum += result.z[i];
  EXPECT_NEAR(sum, 4.0 / 3, kRounding);
}

// Cottle, Pang and Stone's ray of solutions (t, 1 + t): on the tie the driven row itself must enter the
// basis, or this solvable problem looks unsolvable.
TEST(Dantzig, LetsTheDrivenRowEnterOnATie) {
  expect_solution(MatX{{1, -1}, {-1, 1}}, VecX{{1, -1}}, VecX{{0, 1}});
  EXPECT_EQ(solve_dantzig({MatX{{1, -1}, {-1, 1}}, VecX{{1, -1}}}).pivots, 1);  // and no detour
}

TEST(Dantzig, IgnoresZeroRowsThatDoNotApproach) {
  expect_solution(MatX{{0, 0}, {0, 2}}, VecX{{0, -1}}, VecX{{0, 0.5}});
}

TEST(Dantzig, ProvesThatThereIsNoSolution) {
  EXPECT_EQ(solve_dantzig({MatX{{0}}, VecX{{-1}}}).status, Status::no_solution);
  EXPECT_EQ(solve_dantzig({MatX{{1, -1}, {-1, 1}}, VecX{{-2, 1}}}).status, Status::no_solution);
  EXPECT_EQ(solve_dantzig({MatX{{1, -1}, {-1, 1}} * 1e-8, VecX{{-2, 1}} * 1e5}).status, Status::no_solution);
}

TEST(Dantzig, DoesNotTakeRoundOffInTheVectorForAProof) {
  // Held between two walls: the rows must add up to zero, and fail to do so by round-off.
  const LcpResult result = solve_dantzig({MatX{{1, -1}, {-1, 1}}, VecX{{-1, 1 - 2e-16}}});
  EXPECT_EQ(result.status, Status::solved);
}

TEST(Dantzig, RefusesMatricesThatItIsNotMadeFor) {
  EXPECT_EQ(solve_dantzig({MatX{{-1}}, VecX{{1}}}).status, Status::unsuited);
  EXPECT_EQ(solve_dantzig({MatX{{-1}}, VecX{{-1}}}).status, Status::no_solution);  // its row is the proof
  EXPECT_EQ(solve_dantzig({MatX{{0, 1}, {1, 0}}, VecX{{-1, -1}}}).status, Status::unsuited);
}

// The proof is valid for any matrix, so it may be found before the kind of matrix is known.
TEST(Dantzig, ProvesThatAnIndefiniteProblemHasNoSolution) {
  EXPECT_EQ(solve_dantzig({MatX{{1, -2}, {-2, 1}}, VecX{{-1, -1}}}).status, Status::no_solution);
  EXPECT_EQ(solve_dantzig({MatX{{1, -2}, {-2, 1}}, VecX{{1, -1}}}).status, Status::no_solution);
}

TEST(Dantzig, ReportsThePivotLimit) {
  const LcpResult result = solve_dantzig({MatX::Identity(3, 3), VecX::Constant(3, -1)}, {.max_pivots = 2});
  EXPECT_EQ(result.status, Status::limit);
  EXPECT_TRUE(result.z.allFinite());
}

// A relative of the families of Murty (1978) and Fathi (1979), on which pivoting takes ever longer: 11 pivots
// for n = 4, 299 for 12, 16,175 for 40. The default limit ends it, and nothing is called solved that is not.
TEST(Dantzig, EndsOnAProblemThatTakesTooManyPivots) {
  const int n = 40;
  MatX M = MatX::Identity(n, n);
  VecX b = VecX::Zero(n);
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) M(i, j) = 2;
    for (int j = i; j < n; ++j) b[i] -= std::exp2(j);
  }
  const MatX A = M * M.transpose();
  const LcpResult result = solve_dantzig({A, b}, {.predict = false});
  EXPECT_EQ(result.status, Status::limit);
  EXPECT_LE(result.pivots, 100 + 50 * n);
  EXPECT_TRUE(result.z.allFinite());
  const LcpResult patient = solve_dantzig({A, b}, {.max_pivots = 100000, .predict = false});
  EXPECT_EQ(patient.status, Status::solved);
  EXPECT_GT(patient.pivots, 10000);
}

// Matrices that are not symmetric, but have positive principal minors.
TEST(Dantzig, SolvesPMatrices) {
  const MatX A{{1, 2, 2}, {0, 1, 2}, {0, 0, 1}};  // Murty 1978; z = (0, 0, 1)
  for (const MatX& M : {A, MatX(A.transpose())}) {
    const LcpResult result = solve_dantzig({M, VecX{{-1, -1, -1}}});
    ASSERT_EQ(result.status, Status::solved);
    EXPECT_LE(result.residual, 1e-15);
  }
  EXPECT_EQ(solve_dantzig({A, VecX{{-1, -1, -1}}}).z, (VecX{{0, 0, 1}}));
}

// min 1/2 z'Az + b'z in a box: a row that reaches its bound keeps a w of the other sign.
TEST(Dantzig, KeepsBounds) {
  const MatX A{{2, 1}, {1, 2}};
  const VecX b{{-4, 1}}, lower{{0, -1}}, upper{{1.5, 1}};
  const LcpResult result = solve_dantzig({A, b, &lower, &upper});
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_EQ(result.z, (VecX{{1.5, -1}}));
  EXPECT_EQ(result.w, (VecX{{-2, 0.5}}));
  const VecX nothing{{0, 0}}, wide = VecX::Constant(2, std::numeric_limits<double>::infinity());
  EXPECT_EQ(solve_dantzig({A, b, &nothing, &wide}).z, solve_dantzig({A, b}).z);
  const VecX minus = -wide;  // no bounds at all: a linear system
  EXPECT_NEAR((A * solve_dantzig({A, b, &minus, &wide}).z + b).norm(), 0, 1e-15);
}

// Whatever the guess, the answer is right; a right guess needs no exchange after it.
TEST(Dantzig, BeginsWithAnyGuess) {
  const MatX A{{2, -1, 0}, {-1, 2, -1}, {0, -1, 2}};
  const VecX b{{-1, 2, -3}};
  const VecX expected{{0.5, 0, 1.5}};
  for (const VecX& guess : {expected, VecX{{0, 0, 0}}, VecX{{1, 1, 1}}, VecX{{0, 7, 0}}}) {
    const LcpResult result = solve_dantzig({A, b}, {.start = &guess});
    ASSERT_EQ(result.status, Status::solved);
    EXPECT_NEAR((result.z - expected).norm(), 0, 1e-15);
    EXPECT_LE(result.pivots, 4);  // the guess's rows, and what had to be exchanged: no second attempt
  }
  const VecX short_guess{{1}};
  EXPECT_THROW(solve_dantzig({A, b}, {.start = &short_guess}), std::invalid_argument);
}

TEST(Dantzig, RefusesCallersMistakes) {
  EXPECT_THROW(solve_dantzig({MatX::Zero(2, 3), VecX::Zero(2)}), std::invalid_argument);
  EXPECT_THROW(solve_dantzig({MatX::Identity(2, 2), VecX::Zero(3)}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solve_dantzig({MatX{{nan}}, VecX{{1}}}), std::invalid_argument);
  EXPECT_THROW(solve_dantzig({MatX{{1}}, VecX{{nan}}}), std::invalid_argument);
}

// Near the ends of what a double can hold, an answer is either right or refused, and always finite.
TEST(Dantzig, NeverReturnsANumberThatIsNotFinite) {
  for (const double a : {1e-300, 1.0, 1e300}) {
    for (const double b : {-1e-300, -1.0, -1e300}) {
      const LcpResult result = solve_dantzig({MatX{{a, 0}, {0, 1}}, VecX{{b, -1}}});
      EXPECT_TRUE(result.z.allFinite() && result.w.allFinite()) << a << ' ' << b;
      EXPECT_FALSE(std::isnan(result.residual)) << a << ' ' << b;
      EXPECT_TRUE(result.status != Status::solved || result.residual <= kRounding) << a << ' ' << b;
    }
  }
}

TEST(Dantzig, DoesNotCareForUnits) {
  const MatX A{{2, -1, 0.5}, {-1, 2, 0}, {0.5, 0, 1}};
  const VecX b{{-2, 0, -0.5}};
  const LcpResult expected = solve_dantzig({A, b});
  ASSERT_EQ(expected.status, Status::solved);
  for (const double unit : {0x1p-40, 0x1p40}) {  // powers of two: the same bits are due
    const LcpResult result = solve_dantzig({A * unit, b});
    EXPECT_EQ(result.w, expected.w);
    EXPECT_EQ(result.z * unit, expected.z);
  }
}

}  // namespace
}  // namespace fc::lcp

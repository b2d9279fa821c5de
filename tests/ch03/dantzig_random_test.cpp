// Dantzig's method against trying every active set, and against problems built around a known solution.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "brute_force.hpp"
#include "ch03_impulse_lcp/dantzig.hpp"

namespace fc::lcp {
namespace {

// A = G'G with small whole numbers, of any rank from 0 to n, often with equal rows: products are exact, ties
// and degenerate pivots abound.
MatX any_gram_matrix(int n) {
  const int rank = *rc::gen::inRange(0, n + 1);
  MatX G(rank, n);
  for (double& x : G.reshaped()) x = *rc::gen::inRange(-2, 3);
  return G.transpose() * G;
}

VecX any_whole_numbers(int n, int least, int most) {
  VecX v(n);
  for (double& x : v) x = *rc::gen::inRange(least, most + 1);
  return v;
}

// b is arbitrary: solvable or not is for both methods to find out.
RC_GTEST_PROP(DantzigRandom, AgreesWithBruteForce, ()) {
  const int n = *rc::gen::inRange(1, 9);
  const MatX A = any_gram_matrix(n);
  const VecX b = any_whole_numbers(n, -3, 3);
  const LcpResult result = solve_dantzig({A, b});
  const auto z = brute_force(A, b, 1e-9);
  RC_ASSERT(result.status == (z ? Status::solved : Status::no_solution));
  if (!z) return;
  RC_ASSERT(result.residual <= 1e-13);
  RC_ASSERT((result.w - (A * *z + b)).lpNorm<Eigen::Infinity>() <= 1e-9);  // w is unique, z need not be
}

// Solvable by construction, with a mixed active set: rows with z > 0, with w > 0, and with both zero.
RC_GTEST_PROP(DantzigRandom, SolvesWhatHasASolution, ()) {
  const int n = *rc::gen::inRange(1, 25);
  const MatX A = any_gram_matrix(n);
  VecX z = any_whole_numbers(n, 0, 3), w = any_whole_numbers(n, 0, 3);
  for (int i = 0; i < n; ++i) (*rc::gen::arbitrary<bool>() ? z : w)[i] = 0;
  const VecX b = w - A * z;
  const LcpResult result = solve_dantzig({A, b});
  RC_ASSERT(result.status == Status::solved);
  RC_ASSERT(result.residual <= 1e-13);
  RC_ASSERT((result.w - w).lpNorm<Eigen::Infinity>() <= 1e-12 * (1 + b.lpNorm<Eigen::Infinity>()));
}

struct Family {
  const char* name;
  int n, draws;
  double worst_residual;  // measured, times ten or so
};

// G has a random rank and normally distributed entries; `spread` scales its rows (like masses do) over that
// many decades, `copies` columns are equal up to `difference`. Solvable by construction.
void solve_family(const Family& family, double spread, int copies, double difference) {
  std::mt19937_64 random(20080101);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const int n = family.n;
  for (int draw = 0; draw < family.draws; ++draw) {
    const int rank = 1 + static_cast<int>(uniform(random) * n);
    MatX G(rank, n);
    for (double& x : G.reshaped()) x = normal(random);
    for (int j = 0; j < n; ++j) {
      if (j % copies == 0) continue;
      for (int i = 0; i < rank; ++i) G(i, j) = G(i, j - j % copies) + difference * normal(random);
    }
    for (int i = 0; i < rank; ++i) G.row(i) *= std::pow(10.0, spread * (uniform(random) - 0.5));
    const MatX A = G.transpose() * G;
    VecX z = VecX::Zero(n), w = VecX::Zero(n);
    for (int i = 0; i < n; ++i) {
      const double kind = uniform(random);
      if (kind < 0.4) z[i] = uniform(random);
      if (kind > 0.6) w[i] = uniform(random);
    }
    const VecX b = w - A * z;
    const LcpResult result = solve_dantzig({A, b});
    ASSERT_EQ(result.status, Status::solved) << family.name << ", draw " << draw;
    ASSERT_LE(result.residual, family.worst_residual) << family.name << ", draw " << draw;
  }
}

TEST(DantzigRandom, SolvesProblemsOfAnyRank) {
  solve_family({"n = 12", 12, 300, 1e-12}, 0, 1, 0);
  solve_family({"n = 60", 60, 30, 1e-12}, 0, 1, 0);
}

TEST(DantzigRandom, SolvesRowsGivenEightTimes) {
  solve_family({"n = 16", 16, 300, 1e-12}, 0, 8, 0);
  solve_family({"n = 80", 80, 30, 1e-12}, 0, 8, 0);
}

TEST(DantzigRandom, SolvesRowsThatDifferByAlmostNothing) {
  solve_family({"differing by 1e-15", 16, 200, 1e-10}, 0, 4, 1e-15);
  solve_family({"differing by 1e-12", 16, 200, 1e-10}, 0, 4, 1e-12);
  solve_family({"differing by 1e-9", 16, 200, 1e-10}, 0, 4, 1e-9);
  solve_family({"differing by 1e-6", 16, 200, 1e-10}, 0, 4, 1e-6);
}

TEST(DantzigRandom, SolvesEightDecadesOfEigenvalues) {
  solve_family({"n = 8", 8, 300, 1e-10}, 4, 1, 0);  // rows of G over 4 decades: A over 8
  solve_family({"n = 40", 40, 50, 1e-10}, 4, 1, 0);
}

}  // namespace
}  // namespace fc::lcp

// Dantzig's method on every family of the problem factory: the planted w comes out, or the certificate.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/problem_factory.hpp"

namespace fc::lcp {
namespace {

class DantzigFamilies : public testing::TestWithParam<Family> {};

// Hilbert's matrix from n = 13 on has eigenvalues below round-off: w is then known to the root of round-off
// only, see problem_factory.hpp. All others: to the last digits, whatever condition, ranks and masses are.
double w_tolerance(const KnownProblem& p) {
  return p.family == Family::hilbert && !p.exact ? 1e-7 : 1e-13;
}

// What is symmetric, semidefinite and without bounds has to be solved. Beyond that the method may refuse, and
// where pivots double with every row it may give up; what it calls solved is right all the same.
bool may_refuse(const KnownProblem& p, Status status) {
  const bool doubling = p.family >= Family::murty && p.family <= Family::csizmadia_reversed && !p.symmetric;
  return (status == Status::unsuited && (!p.symmetric || p.lcp().boxed())) ||
         (status == Status::limit && doubling);
}

TEST_P(DantzigFamilies, FindsThePlantedAnswerOrTheCertificate) {
  for (const Eigen::Index n : {8, 32, 96})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const KnownProblem p = make_problem(GetParam(), n, seed);
      SCOPED_TRACE("n = " + std::to_string(n) + ", seed " + std::to_string(seed));
      const LcpResult result = solve_dantzig(p.lcp());
      if (may_refuse(p, result.status)) continue;
      EXPECT_STREQ(name(result.status), name(p.solvable ? Status::solved : Status::no_solution));
      if (!p.solvable || result.status != Status::solved) continue;
      EXPECT_LE(result.residual, 1e-13);
      EXPECT_LE((result.w - p.w).lpNorm<Eigen::Infinity>(), w_tolerance(p) * p.b.lpNorm<Eigen::Infinity>());
    }
}

INSTANTIATE_TEST_SUITE_P(All, DantzigFamilies, testing::ValuesIn(kFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

// Regression cases: of 200 seeds of each size, those that Dantzig's method once gave up on.
TEST(DantzigInfeasible, CertificatesThatWereOnceMissed) {
  struct Missed {
    Eigen::Index n;
    std::vector<std::uint64_t> seeds;
  };
  const std::vector<Missed> missed = {
      {8, {56, 82}},     {12, {4, 70, 117, 165}}, {16, {113, 165}},   {24, {34, 131, 175, 200}},
      {32, {3, 26, 75}}, {48, {52, 89, 148}},     {64, {28, 69, 135}}};
  for (const Missed& m : missed)
    for (const std::uint64_t seed : m.seeds) {
      const KnownProblem p = make_problem(Family::infeasible, m.n, seed);
      const LcpResult result = solve_dantzig(p.lcp());
      EXPECT_STREQ(name(result.status), "no_solution") << "n = " << m.n << ", seed " << seed;
    }
}

}  // namespace
}  // namespace fc::lcp

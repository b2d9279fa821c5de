// The clear Dantzig against the fast one, and the checks of the solver that runs on a piece.
#include <gtest/gtest.h>

#include "ch03_impulse_lcp/clear/solver.hpp"
#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/problem_factory.hpp"
#include "common/scene.hpp"

namespace fc::lcp {
namespace {

class ClearDantzig : public testing::TestWithParam<Family> {};

TEST_P(ClearDantzig, EndsAsTheFastOneDoes) {
  for (const Eigen::Index n : {8, 16, 32, 60})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const KnownProblem p = make_problem(GetParam(), n, seed);
      if (!p.symmetric || !p.semidefinite || p.lcp().boxed()) continue;
      if (p.family == Family::hilbert && !p.exact) continue;  // eigenvalues below round-off
      SCOPED_TRACE("n = " + std::to_string(n) + ", seed " + std::to_string(seed));
      const LcpResult clear = clear::dantzig(p.A, p.b, 0), fast = solve_dantzig(p.lcp());
      EXPECT_EQ(clear.status, fast.status);
      if (clear.status == Status::no_solution) {
        EXPECT_TRUE(certifies_no_solution(p.lcp(), clear.certificate));
      }
      if (clear.status != Status::solved || fast.status != Status::solved) continue;
      EXPECT_LE(residual(p.lcp(), clear.z, clear.w), 1e-13);
      EXPECT_LE((clear.w - fast.w).lpNorm<Eigen::Infinity>(), 1e-10 * p.b.lpNorm<Eigen::Infinity>());
    }
}

INSTANTIATE_TEST_SUITE_P(All, ClearDantzig, testing::ValuesIn(kFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

const MatX kMatrix{{1.5, -0.5}, {-0.5, 1.5}};
const VecX kVector{{-3, -1.5}};

LcpResult all_lies(const MatX&, const VecX& b, int) {
  LcpResult result;
  result.status = Status::solved;
  result.z = VecX::Ones(b.size());
  return result;
}

LcpResult no_proof(const MatX&, const VecX& b, int) {
  LcpResult result;
  result.status = Status::no_solution;
  result.z = VecX::Zero(b.size());
  result.certificate = VecX::Ones(b.size());
  return result;
}

LcpResult nothing(const MatX&, const VecX&, int) {
  return {};
}

TEST(ClearSolver, SolvesByThePiece) {
  const LcpResult result = clear::solver_of(SolverSpec(), {})({kMatrix, kVector});
  EXPECT_EQ(result.status, Status::solved);
  EXPECT_NEAR(result.z[0], 21. / 8, 1e-14);
  EXPECT_LE(result.residual, 1e-15);
}

TEST(ClearSolver, TakesNobodysWord) {
  for (clear::DantzigFunction* piece : {&all_lies, &no_proof, &nothing}) {
    const LcpResult result = clear::solver_of(SolverSpec(), {piece})({kMatrix, kVector});
    EXPECT_EQ(result.status, Status::limit);
    EXPECT_EQ(result.z.size(), 2);
    EXPECT_EQ(result.w, evaluate(kMatrix, kVector, result.z));
  }
}

TEST(ClearSolver, LeavesOtherMethodsAndBoundsAlone) {
  SolverSpec lemke;
  lemke.method = "lemke";
  EXPECT_EQ(clear::solver_of(lemke, {&nothing})({kMatrix, kVector}).status, Status::solved);
  const VecX lower = VecX::Constant(2, -1);
  EXPECT_EQ(clear::solver_of(SolverSpec(), {})({kMatrix, kVector, &lower}).status, Status::unsuited);
  EXPECT_EQ(clear::solver_of(SolverSpec(), {})({MatX{{2, 1}, {-1, 2}}, kVector}).status, Status::unsuited);
}

}  // namespace
}  // namespace fc::lcp

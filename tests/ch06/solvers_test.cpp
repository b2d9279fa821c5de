// Every method behind solve(): closed forms, statuses, and no wrong answer called solved.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch06_friction/friction_solver.hpp"
#include "cones.hpp"

namespace fc::friction {
namespace {

class EveryFrictionMethod : public testing::TestWithParam<Method> {
 protected:
  ConeResult solve(const ConeProblem& problem, const SolveOptions& options = {}) const {
    return friction::solve(problem, GetParam(), options);
  }
  // What only the cone's methods can solve; the others must report that they did not.
  bool knows_cones() const { return GetParam() != Method::pyramid && GetParam() != Method::boxed; }
};

INSTANTIATE_TEST_SUITE_P(Methods, EveryFrictionMethod, testing::ValuesIn(kMethods),
                         [](const auto& method) { return std::string(name(method.param)); });

// Two blocks of 1 kg, one on the other, on a floor that pulls: R11 of the notes. Contact 0 is on the floor.
OwnProblem stack(double mu_floor, double mu_between, double pull) {
  OwnProblem p{MatX::Zero(6, 6), VecX(6), VecX{{mu_floor, mu_between}}};
  for (int k = 0; k < 3; ++k) {
    p.A(k, k) = 1;  // the lower block against the floor
    p.A(k, 3 + k) = -1;
    p.A(3 + k, k) = -1;
    p.A(3 + k, 3 + k) = 2;  // the upper one against the lower
  }
  p.b << -1, pull, 0, 0, -pull, 0;  // both fall by 1 m/s in a step; the lower is pulled
  return p;
}

TEST_P(EveryFrictionMethod, PullsTheLowerOfTwoBlocks) {
  // Together up to (µ_floor + µ_between) (m_1 + m_2) g, then at different speeds.
  const ConeResult rests = solve(stack(0.25, 0.5, 0.4));
  ASSERT_EQ(rests.status, Status::solved);
  EXPECT_NEAR(rests.u.norm(), 0, 1e-9);
  EXPECT_NEAR(rests.r[0], 2, 1e-9);
  const ConeResult together = solve(stack(0.25, 0.5, 1.2));
  ASSERT_EQ(together.status, Status::solved);
  EXPECT_NEAR(together.u[1], 0.35, 1e-9);
  EXPECT_NEAR(together.u[4], 0, 1e-9);
  const ConeResult apart = solve(stack(0.25, 0.5, 2));
  ASSERT_EQ(apart.status, Status::solved);
  EXPECT_NEAR(apart.u[1], 2 - 0.5 - 0.5, 1e-9);
  EXPECT_NEAR(apart.u[4], 0.5 - 1, 1e-9);
}

TEST_P(EveryFrictionMethod, SlidesAgainstTheSlipOrSaysThatItDoesNot) {
  const MatX A = MatX::Identity(3, 3);
  const VecX b{{-1, 3, 4}}, mu{{0.5}};
  const ConeResult result = solve({A, b, mu}, {.limit = 30});
  if (GetParam() == Method::boxed) {
    EXPECT_EQ(result.status, Status::limit);
    EXPECT_EQ(result.r, (VecX{{1, -0.5, -0.5}}));
    return;
  }
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_NEAR((result.r - VecX{{1, -0.3, -0.4}}).norm(), 0, 1e-9);
}

TEST_P(EveryFrictionMethod, HasNothingToDo) {
  const MatX A = MatX::Identity(6, 6);
  const VecX b{{1, 5, 0, 0, -1, 2}}, mu{{0.5, 2}};
  const ConeResult apart = solve({A, b, mu});
  EXPECT_EQ(apart.status, Status::solved);
  EXPECT_EQ(apart.r, VecX::Zero(6));
  EXPECT_EQ(apart.u, b);
  EXPECT_EQ(solve({MatX(0, 0), VecX(0), VecX(0)}).status, Status::solved);
}

TEST_P(EveryFrictionMethod, NamesWhatItCannotHave) {
  const VecX mu{{0.5}}, falls{{-1, 0, 0}};
  const MatX fixed = Vec3(0, 1, 1).asDiagonal();
  EXPECT_EQ(solve({fixed, falls, mu}).status, Status::no_solution);
  const MatX skew{{1, 0.5, 0}, {-0.5, 1, 0}, {0, 0, 1}}, negative = -MatX::Identity(3, 3);
  EXPECT_EQ(solve({skew, falls, mu}).status, Status::unsuited);
  EXPECT_EQ(solve({negative, falls, mu}).status, Status::unsuited);
  const VecX none(2);
  EXPECT_THROW(solve({fixed, falls, none}), std::invalid_argument);
  EXPECT_THROW(solve({fixed, falls, mu}, {.start = &none}), std::invalid_argument);
  EXPECT_THROW(solve({fixed, falls, mu}, {.sides = 5}), std::invalid_argument);
}

// An answer called solved obeys the law, whichever method found it: random contacts of any rank, one in eight without
// friction.
TEST_P(EveryFrictionMethod, CallsNoWrongAnswerSolved) {
  std::mt19937_64 random(20080101);
  int solved = 0;
  constexpr int kDraws = 300;
  for (int draw = 0; draw < kDraws; ++draw) {
    SCOPED_TRACE(draw);
    const Eigen::Index n = 1 + draw % 6, freedom = 1 + draw % 11;
    OwnProblem p = random_problem(random, n, freedom, 0, draw % 3);
    for (double& mu : p.mu) mu = std::max(0.0, uniform(random, -0.3, 2));
    const ConeResult result = solve(p);
    ASSERT_TRUE(result.r.allFinite() && result.u.allFinite());
    if (result.status != Status::solved) continue;
    ++solved;
    EXPECT_LE(result.residual, 1e-10);
    EXPECT_LE(broken_law(p, result.r, result.u), 1e-9 * size_of(p, result.r));
    EXPECT_LE((p.A * result.r + p.b - result.u).norm(), 1e-13 * (1 + size_of(p, result.r)));
  }
  if (GetParam() == Method::combined) {
    EXPECT_EQ(solved, kDraws);
  }
  if (GetParam() == Method::gauss_seidel) {
    EXPECT_GE(solved, kDraws * 8 / 10);
  }
}

TEST_P(EveryFrictionMethod, StopsAtItsLimit) {
  std::mt19937_64 random(20080102);
  const OwnProblem p = random_problem(random, 10, 20, 0.5);
  const ConeResult result = solve(p, {.limit = 1});
  EXPECT_TRUE(result.r.allFinite());
  if (GetParam() != Method::combined) {
    EXPECT_EQ(result.status, Status::limit);
    EXPECT_LE(result.sweeps + result.steps, 1);
  }
}

TEST_P(EveryFrictionMethod, WithoutFrictionIsChapterThree) {
  std::mt19937_64 random(20080103);
  for (int draw = 0; draw < 50; ++draw) {
    SCOPED_TRACE(draw);
    const OwnProblem p = random_problem(random, 1 + draw % 8, 12, 0);
    std::vector<Eigen::Index> normals;
    for (Eigen::Index i = 0; i < p.mu.size(); ++i) normals.push_back(3 * i);
    const MatX A = p.A(normals, normals);
    const VecX b = p.b(normals);
    const lcp::LcpResult known = lcp::solve_dantzig({A, b});
    const ConeResult result = solve(p);
    ASSERT_EQ(result.status, Status::solved);
    const double close = GetParam() == Method::combined ? 1e-14 : 1e-9;
    EXPECT_LE((result.u(normals) - known.w).lpNorm<Eigen::Infinity>(), close * size_of(p, result.r));
  }
}

TEST(FrictionMethods, HaveNamesThatAreReadBack) {
  for (const Method method : kMethods) EXPECT_EQ(method_named(name(method)), method);
  EXPECT_THROW(method_named("gauss"), std::invalid_argument);
}

TEST(GaussSeidel, TakesAGuess) {
  std::mt19937_64 random(20080104);
  OwnProblem p = random_problem(random, 5, 15, 0.4);
  for (Eigen::Index row = 0; row < 15; row += 3) p.b[row] = -1;
  const ConeResult first = solve(p, Method::gauss_seidel);
  ASSERT_EQ(first.status, Status::solved);
  EXPECT_GT(first.sweeps, 1);
  EXPECT_EQ(solve(p, Method::gauss_seidel, {.start = &first.r}).sweeps, 0);
}

TEST(Newton, IsQuadraticNearAnAnswer) {
  std::mt19937_64 random(20080105);
  const OwnProblem p = random_problem(random, 8, 24, 0.4);
  const ConeResult near = solve(p, Method::gauss_seidel, {.limit = 30});
  const ConeResult result = solve(p, Method::newton, {.start = &near.r});
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_LE(result.steps, 4);
}

// In a problem in the plane box friction is exact.
TEST(Boxed, IsExactInTheDirectionOfATangent) {
  std::mt19937_64 random(20080106);
  int solved = 0;
  for (int draw = 0; draw < 100; ++draw) {
    OwnProblem p = random_problem(random, 3, 9, 0.4);
    for (Eigen::Index row = 2; row < 9; row += 3) {
      p.A.row(row).setZero();
      p.A.col(row).setZero();
      p.b[row] = 0;
    }
    const ConeResult result = solve(p, Method::boxed);
    if (result.status == Status::solved) ++solved;
  }
  EXPECT_GE(solved, 90);
}

TEST(Pyramid, TurnedComesNearerToTheCone) {
  std::mt19937_64 random(20080107);
  int nearer = 0;
  for (int draw = 0; draw < 30; ++draw) {
    const OwnProblem p = random_problem(random, 3, 9, 0.5);
    const ConeResult flat = solve(p, Method::pyramid, {.turned = false}), turned = solve(p, Method::pyramid);
    EXPECT_LE(turned.residual, flat.residual);
    if (turned.residual < 0.1 * flat.residual) ++nearer;
  }
  EXPECT_GE(nearer, 10);
}

}  // namespace
}  // namespace fc::friction

// Every method behind solve(): closed forms, the families with known answers, enumeration, invariances,
// statuses.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <random>
#include <string>

#include "ch03_impulse_lcp/problem_factory.hpp"
#include "ch03_impulse_lcp/solver.hpp"
#include "tests/ch03/brute_force.hpp"

namespace fc::lcp {
namespace {

class EveryMethod : public testing::TestWithParam<Method> {
 protected:
  LcpResult solve(const Lcp& problem, const SolveOptions& options = {}) const {
    return lcp::solve(problem, GetParam(), options);
  }
  // What the default tolerance of the iterative methods, a residual of 1e-10, leaves of w.
  static constexpr double kClose = 1e-9;
};

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn(kMethods),
                         [](const auto& method) { return std::string(name(method.param)); });

TEST_P(EveryMethod, SolvesByHand) {
  const LcpResult cradle = solve({MatX{{2, -1}, {-1, 2}}, VecX{{-2, 0}}});  // Newton's cradle of three
  ASSERT_EQ(cradle.status, Status::solved);
  EXPECT_NEAR(cradle.z[0], 4.0 / 3, kClose);
  EXPECT_NEAR(cradle.z[1], 2.0 / 3, kClose);
  const LcpResult mixed = solve({MatX{{2, 1}, {1, 2}}, VecX{{-2, 3}}});
  ASSERT_EQ(mixed.status, Status::solved);
  EXPECT_NEAR(mixed.z[0], 1, kClose);
  EXPECT_EQ(mixed.z[1], 0);
  EXPECT_NEAR(mixed.w[1], 4, kClose);
  const LcpResult one = solve({MatX{{4}}, VecX{{-2}}});
  ASSERT_EQ(one.status, Status::solved);
  EXPECT_NEAR(one.z[0], 0.5, kClose);
}

TEST_P(EveryMethod, HasNothingToDo) {
  const LcpResult apart = solve({MatX{{2, -1}, {-1, 2}}, VecX{{0, 3}}});
  EXPECT_EQ(apart.status, Status::solved);
  EXPECT_EQ(apart.z, (VecX{{0, 0}}));
  EXPECT_EQ(apart.pivots, 0);
  EXPECT_EQ(solve({MatX(0, 0), VecX(0)}).status, Status::solved);
}

// On a tie the artificial unknown, or the row that is driven, must win, or the solution is lost (failure F8
// of others).
TEST_P(EveryMethod, KeepsTheSolutionOnATie) {
  const LcpResult result = solve({MatX{{1, -1}, {-1, 1}}, VecX{{1, -1}}});
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_NEAR(result.w.lpNorm<Eigen::Infinity>(), 0, kClose);
}

TEST_P(EveryMethod, RefusesCallersMistakes) {
  EXPECT_THROW(solve({MatX::Zero(2, 3), VecX::Zero(2)}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solve({MatX{{nan}}, VecX{{1}}}), std::invalid_argument);
  const VecX lower{{1.0}};
  EXPECT_THROW(solve({MatX{{1}}, VecX{{1}}, &lower}), std::invalid_argument);
}

TEST_P(EveryMethod, StopsAtItsLimit) {
  const KnownProblem p = make_problem(Family::spd_1e8, 32, 1);
  const LcpResult result = solve(p.lcp(), {.limit = 2});
  EXPECT_EQ(result.status, Status::limit);
  EXPECT_TRUE(result.z.allFinite());
  EXPECT_LE(result.pivots, 2);
}

TEST_P(EveryMethod, KeepsBoundsOrRefusesThem) {
  const MatX A{{2, 1}, {1, 2}};
  const VecX b{{-4, 1}}, lower{{0, -1}}, upper{{1.5, 1}};
  const LcpResult result = solve({A, b, &lower, &upper});
  if (GetParam() == Method::lemke || GetParam() == Method::interior_point) {
    EXPECT_EQ(result.status, Status::unsuited);
    return;
  }
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_NEAR(result.z[0], 1.5, kClose);
  EXPECT_NEAR(result.z[1], -1, kClose);
}

// Where a method is bound to succeed. PGS needs a matrix of moderate condition, Murty's takes Lemke 2^n
// pivots, and Csizmadia's z is made to lead interior points astray.
bool must_solve(Method method, const KnownProblem& p) {
  const Family f = p.family;
  const bool doubling = f == Family::murty,
             astray = f == Family::csizmadia || f == Family::csizmadia_reversed;
  switch (method) {
    case Method::dantzig:
      return true;
    case Method::lemke:
      return !p.lcp().boxed() && !doubling;
    case Method::pgs:
      return f == Family::random_spd || f == Family::all_active || f == Family::degenerate ||
             f == Family::ball_heap || f == Family::duplicate_contacts || f == Family::graded ||
             f == Family::positive_definite || f == Family::boxed || f == Family::triangular;
    case Method::interior_point:
      return !p.lcp().boxed() && !astray;
  }
  return false;
}

TEST_P(EveryMethod, FindsThePlantedAnswerOrSaysThatItDidNot) {
  for (const Family family : kFamilies)
    for (const Eigen::Index n : {8, 24})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const KnownProblem p = make_problem(family, n, seed);
        SCOPED_TRACE(std::string(name(family)) + ", n = " + std::to_string(n) + ", seed " +
                     std::to_string(seed));
        const LcpResult result = solve(p.lcp(), {.limit = GetParam() == Method::pgs ? 2000 : 0});
        if (!p.solvable) {
          const bool proves = GetParam() != Method::pgs;
          EXPECT_STREQ(name(result.status), proves ? "no_solution" : "limit");
          continue;
        }
        if (must_solve(GetParam(), p)) {
          EXPECT_STREQ(name(result.status), "solved");
        }
        EXPECT_NE(result.status, Status::no_solution);
        if (result.status != Status::solved) continue;
        EXPECT_LE(result.residual, 1e-10);
        const double close = family == Family::hilbert ? 1e-6 : 1e-8;
        EXPECT_LE((result.w - p.w).lpNorm<Eigen::Infinity>(), close * p.b.lpNorm<Eigen::Infinity>());
      }
}

// A random problem of small whole numbers: any rank, ties, solvable or not.
struct Small {
  MatX A;
  VecX b;
};
Small small_problem(bool symmetric) {
  const int n = *rc::gen::inRange(1, 7), rank = *rc::gen::inRange(1, n + 1);
  const auto whole = [] { return static_cast<double>(*rc::gen::inRange(-3, 4)); };
  MatX G(rank, n);
  VecX b(n);
  for (double& g : G.reshaped()) g = whole();
  for (double& v : b) v = whole();
  MatX A = G.transpose() * G;
  if (!symmetric) {  // plus a skew part: still x'Ax >= 0
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j) {
        const double s = whole();
        A(i, j) += s;
        A(j, i) -= s;
      }
  }
  return {A, b};
}

// Lemke's method decides every problem with a positive semidefinite matrix, and interior points most: a method that
// claims an answer agrees with the trial of every active set.
RC_GTEST_PROP(SolversRandom, AgreeWithEnumeration, ()) {
  const Small p = small_problem(true);
  const auto truth = brute_force(p.A, p.b, 1e-9);
  for (const Method method : {Method::lemke, Method::interior_point, Method::dantzig, Method::pgs}) {
    const LcpResult result = solve({p.A, p.b}, method);
    if (truth) {
      RC_ASSERT(result.status != Status::no_solution && result.status != Status::unsuited);
      if (method == Method::lemke || method == Method::dantzig) RC_ASSERT(result.status == Status::solved);
    } else {
      RC_ASSERT(result.status != Status::solved);
      if (method == Method::lemke || method == Method::dantzig)
        RC_ASSERT(result.status == Status::no_solution);
    }
    if (result.status != Status::solved) continue;
    const double difference = (result.w - (p.A * *truth + p.b)).lpNorm<Eigen::Infinity>();
    // A residual of 1e-10 bounds the square of an error in w, where A is singular.
    const double close = method == Method::lemke || method == Method::dantzig ? 1e-8 : 1e-3;
    RC_ASSERT(difference <= close * std::max(1.0, p.b.lpNorm<Eigen::Infinity>()));
  }
}

// Semidefinite, but not symmetric: what Lemke's method is for.
RC_GTEST_PROP(SolversRandom, LemkeDecidesSkewProblems, ()) {
  const Small p = small_problem(false);
  const auto truth = brute_force(p.A, p.b, 1e-9);
  const LcpResult result = solve({p.A, p.b}, Method::lemke);
  if (truth) {
    RC_ASSERT(result.status == Status::solved);
    RC_ASSERT(result.residual <= 1e-10);
  } else {
    RC_ASSERT(result.status != Status::solved);
  }
}

// Other names for the rows, other units for time and mass: the same velocities.
RC_GTEST_PROP(SolversRandom, DoNotDependOnOrderOrUnits, ()) {
  const auto seed = static_cast<std::uint64_t>(*rc::gen::inRange(1, 1000));
  const KnownProblem p = make_problem(Family::random_spd, 12, seed);
  std::mt19937_64 engine(seed);
  Eigen::PermutationMatrix<Eigen::Dynamic> order(12);
  order.setIdentity();
  std::shuffle(order.indices().data(), order.indices().data() + 12, engine);
  const double mass = std::exp2(*rc::gen::inRange(-40, 40)), speed = std::exp2(*rc::gen::inRange(-40, 40));
  const MatX A = order * p.A * order.transpose() / mass;
  const VecX b = order * p.b * speed;
  for (const Method method : kMethods) {
    const LcpResult result = solve({A, b}, method);
    RC_ASSERT(result.status == Status::solved);
    const VecX w = order.transpose() * result.w / speed;
    RC_ASSERT((w - p.w).lpNorm<Eigen::Infinity>() <= 1e-8 * p.b.lpNorm<Eigen::Infinity>());
  }
}

TEST(Lemke, EndsOnARayThoughThereAreSolutions) {  // a bimatrix game; Cottle, Pang and Stone, example 4.4.23
  const MatX A{{0, 0, 10, 20}, {0, 0, 30, 15}, {10, 20, 0, 0}, {30, 15, 0, 0}};
  const VecX b = VecX::Constant(4, -1);
  EXPECT_EQ(solve({A, b}, Method::lemke).status, Status::ray);
}

TEST(Lemke, TakesAsManyPivotsAsTheWorstCaseIsKnownFor) {  // Murty 1978: all 2^n orders of signs
  EXPECT_EQ(solve(make_problem(Family::murty, 8, 1).lcp(), Method::lemke).pivots, 256);
  EXPECT_EQ(solve(make_problem(Family::murty, 24, 1).lcp(), Method::lemke).status, Status::limit);
}

TEST(Pgs, RefusesADiagonalThatItCannotDivideBy) {
  EXPECT_EQ(solve({MatX{{0, 1}, {1, 0}}, VecX{{-1, -1}}}, Method::pgs).status, Status::unsuited);
  EXPECT_EQ(solve({MatX{{0, 0}, {0, 1}}, VecX{{-1, -1}}}, Method::pgs).status, Status::no_solution);
  EXPECT_EQ(solve({MatX{{0, 0}, {0, 1}}, VecX{{1, -1}}}, Method::pgs).status, Status::solved);
}

// A heavy body on light ones: a sweep corrects little more than the ratio of the masses of the fault. (The
// residual alone would not show it: A z is huge, and stands in its denominator.)
TEST(Pgs, IsFarFromTheAnswerWhereMassesDiffer) {
  const KnownProblem p = make_problem(Family::stack_1e8, 8, 2);
  const LcpResult few = solve(p.lcp(), Method::pgs, {.limit = 10});
  EXPECT_EQ(few.status, Status::limit);
  EXPECT_GT((few.w - p.w).lpNorm<Eigen::Infinity>(), 0.1);  // m/s, of speeds of 1/8 to 1
}

TEST(Pgs, BeginsWithAGuess) {
  const KnownProblem p = make_problem(Family::random_spd, 32, 1);
  EXPECT_EQ(solve(p.lcp(), Method::pgs, {.start = &p.z}).pivots, 0);
  EXPECT_GT(solve(p.lcp(), Method::pgs).pivots, 0);
}

TEST(InteriorPoint, TakesHardlyMoreStepsForMoreRows) {
  const int few = solve(make_problem(Family::random_spd, 8, 1).lcp(), Method::interior_point).pivots;
  const int many = solve(make_problem(Family::random_spd, 256, 1).lcp(), Method::interior_point).pivots;
  EXPECT_LE(many, 2 * few);
}

TEST(MethodNames, AreReadBack) {
  for (const Method method : kMethods) EXPECT_EQ(method_named(name(method)), method);
  EXPECT_THROW(method_named("gauss"), std::invalid_argument);
}

// A method that reports no solution returns the proof, which is checked by multiplication.
TEST_P(EveryMethod, NoSolutionComesWithItsCertificate) {
  std::vector<std::pair<MatX, VecX>> problems = {{MatX{{1, -1}, {-1, 1}}, VecX{{-2, 1}}},
                                                 {MatX{{1, -1}, {-1, 1}} * 1e-8, VecX{{-2, 1}} * 1e5},
                                                 {MatX{{1, 0}, {0, 0}}, VecX{{1, -1}}},
                                                 {MatX{{2, 1}, {1, 2}}, VecX{{-1, -1}}}};  // this one has one
  for (const Family family : kFamilies)
    for (const int n : {8, 24})
      if (const KnownProblem p = make_problem(family, n, 3); p.certificate.size() > 0)
        problems.emplace_back(p.A, p.b);
  int proved = 0;
  for (const auto& [A, b] : problems) {
    const LcpResult result = solve({A, b});
    const VecX& y = result.certificate;
    if (result.status != Status::no_solution) {
      EXPECT_EQ(y.size(), 0);
      continue;
    }
    ++proved;
    ASSERT_EQ(y.size(), b.size());
    EXPECT_GE(y.minCoeff(), 0);
    EXPECT_LE((A.transpose() * y).maxCoeff(), 1e-7 * A.cwiseAbs().maxCoeff() * y.sum()) << "A'y <= 0";
    EXPECT_LT(b.dot(y), 0);
  }
  EXPECT_GE(proved, 1);
}

// What the scene's solver.tolerance asks for, an answer of any method has.
TEST_P(EveryMethod, AnAnswerHasTheResidualThatIsAskedFor) {
  const MatX A{{3, -1, 0.3}, {-1, 3, 0.7}, {0.3, 0.7, 3}};
  const VecX b{{-1.1, -0.3, -0.7}};
  EXPECT_EQ(solve({A, b}, {.tolerance = 1e-9}).status, Status::solved);
  EXPECT_NE(solve({A, b}, {.tolerance = 1e-30}).status, Status::solved);
}

}  // namespace
}  // namespace fc::lcp

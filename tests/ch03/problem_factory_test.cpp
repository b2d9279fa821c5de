// The problem factory keeps its word: answers, active sets, ranks, condition numbers, certificates.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "ch03_impulse_lcp/matrix_market.hpp"
#include "ch03_impulse_lcp/problem_factory.hpp"

namespace fc::lcp {
namespace {

constexpr std::array<Eigen::Index, 3> kSizes = {8, 32, 96};

std::string label(const KnownProblem& p) {
  return std::string(name(p.family)) + ", n = " + std::to_string(p.b.size()) + ", seed " +
         std::to_string(p.seed);
}

class Factory : public testing::TestWithParam<Family> {
 protected:
  // Every problem of the family that the tests look at.
  template <class Check>
  void for_each(const Check& check) {
    for (const Eigen::Index n : kSizes)
      for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const KnownProblem p = make_problem(GetParam(), n, seed);
        SCOPED_TRACE(label(p));
        ASSERT_EQ(p.b.size(), n);
        check(p);
      }
  }
};

TEST_P(Factory, PlantedAnswerIsTheAnswer) {
  for_each([](const KnownProblem& p) {
    ASSERT_NO_THROW(check_arguments(p.lcp()));
    EXPECT_EQ(p.solvable, p.z.size() == p.b.size());
    EXPECT_EQ(p.solvable, p.certificate.size() == 0);
    if (!p.solvable) return;
    EXPECT_EQ(residual(p.lcp(), p.z, p.w), 0);
    const VecX w = evaluate(p.A, p.b, p.z);
    EXPECT_LE(planted_floor(p), 1e-13);
    EXPECT_LE(residual(p.lcp(), p.z, w), planted_floor(p));
    EXPECT_TRUE(acceptable(p.lcp(), p.z, w));
    EXPECT_TRUE(acceptable(p.lcp(), p.z, p.w));
    if (p.exact) {
      EXPECT_TRUE(w == p.w);
    }
  });
}

TEST(FactoryHeaps, BoxesAreRedundantBallsAreNot) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto rank = [&](Family family) {
      const VecX s = Eigen::JacobiSVD<MatX>(make_problem(family, 96, seed).A).singularValues();
      return (s.array() > 1e-13 * s[0]).count();
    };
    EXPECT_EQ(rank(Family::ball_heap), 96);
    EXPECT_LT(rank(Family::box_heap), 96);
    EXPECT_GT(rank(Family::box_heap), 48);
  }
}

// A face that carries gives the body above it 1/8 m/s more than the face over that body takes, and no spin.
TEST(FactoryLoads, AreHugeAndInBalance) {
  for (const Family family : {Family::stack, Family::stack_1e4, Family::stack_1e8, Family::tower_1e8})
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const KnownProblem p = make_problem(family, 96, seed);
      const Eigen::Index corners = family == Family::tower_1e8 ? 1 : 4, faces = 96 / corners;
      const double doublings = family == Family::stack ? 0 : family == Family::stack_1e4 ? 14 : 27;
      double above = 0;
      for (Eigen::Index k = faces - 1; k >= 0; --k) {
        const VecX z = p.z.segment(corners * k, corners);
        const double mass = std::exp2(std::round(doublings * static_cast<double>(k) / double(faces - 1)));
        EXPECT_EQ(z.sum(), z.maxCoeff() > 0 ? above + mass / 8 : 0) << label(p) << ", face " << k;
        above = z.sum();
        if (corners == 4) {
          EXPECT_EQ(z[0], z[2]);
          EXPECT_EQ(z[1], z[3]);
        }
      }
    }
}

TEST(FactoryScales, SpreadAsStated) {
  const VecX graded = make_problem(Family::graded, 96, 1).A.diagonal();
  EXPECT_GE(graded[0] / graded[95], 0x1p38);
  EXPECT_LE(graded[0] / graded[95], 0x1p42);
  const MatX chain = make_problem(Family::chain_1e8, 96, 1).A;  // the first ball weighs 1 kg, the second 2^27
  EXPECT_EQ(chain(0, 0), 1);
  EXPECT_EQ(chain(0, 1), -1);
  EXPECT_EQ(chain(1, 2), -0x1p-27);
  const VecX s = Eigen::JacobiSVD<MatX>(make_problem(Family::hilbert, 8, 1).A).singularValues();
  EXPECT_NEAR(s[0] / s[7], 1.5257575e10, 1e6);  // Todd 1954
}

TEST(FactoryWorstCases, AreReversed) {
  const auto expect = [](Family forward, Family backward) {
    const KnownProblem p = make_problem(forward, 9, 1), q = make_problem(backward, 9, 1);
    EXPECT_TRUE(q.A == p.A.reverse() && q.b == p.b.reverse() && q.z == p.z.reverse() && q.w == p.w.reverse());
  };
  expect(Family::murty, Family::murty_reversed);
  expect(Family::fathi, Family::fathi_reversed);
  expect(Family::fathi_shifted, Family::fathi_shifted_reversed);
  expect(Family::csizmadia, Family::csizmadia_reversed);
}

// The public files were made by other hands.
TEST(FactoryWorstCases, AreThePublicOnes) {
  const char* data = std::getenv("FC_DATA");
  const std::filesystem::path folder =
      (data ? std::filesystem::path(data) : std::filesystem::path(FC_SOURCE_DIR) / ".." / "shared" / "data") /
      "lcp" / "families";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no public data";
  const auto expect = [&](Family family, const std::string& file, double b_factor) {
    for (const int n : {4, 8, 64}) {
      const KnownProblem p = make_problem(family, n, 1);
      const std::string base = (folder / (file + "_" + std::to_string(n))).string();
      EXPECT_TRUE(read_matrix_market(base + ".A.mtx") == p.A) << base;
      EXPECT_TRUE(read_matrix_market(base + ".b.mtx") * b_factor == p.b) << base;
      EXPECT_TRUE((read_matrix_market(base + ".z.mtx") * b_factor).isApprox(p.z, 1e-15)) << base;
    }
  };
  expect(Family::murty, "murty", 1);
  expect(Family::fathi, "fathi1", 1);
  expect(Family::fathi_shifted, "fathi2", 5);
  expect(Family::csizmadia, "csizmadia", 1);
}

struct Counts {
  Eigen::Index active = 0, inactive = 0, degenerate = 0, negative = 0;
};

Counts count(const KnownProblem& p) {
  Counts c;
  for (Eigen::Index i = 0; i < p.b.size(); ++i) {
    c.active += p.z[i] > 0 && p.w[i] == 0;
    c.inactive += p.z[i] == 0 && p.w[i] > 0;
    c.degenerate += p.z[i] == 0 && p.w[i] == 0;
    c.negative += p.z[i] < 0 || p.w[i] < 0;
  }
  return c;
}

TEST_P(Factory, ActiveSetsAreMixedAsStated) {
  for_each([](const KnownProblem& p) {
    if (!p.solvable || p.family == Family::boxed || p.family == Family::boxed_deficient) return;
    const Counts c = count(p);
    const Eigen::Index n = p.b.size();
    Eigen::Index active = n / 2, degenerate = 0;
    switch (p.family) {
      case Family::all_active:
        active = n;
        break;
      case Family::degenerate:
        active = degenerate = n / 3;
        break;
      case Family::tower_1e8:
        active = n - n / 4;
        break;
      case Family::murty:
      case Family::fathi:
      case Family::fathi_shifted:
      case Family::murty_reversed:
      case Family::fathi_reversed:
      case Family::fathi_shifted_reversed:
        active = 1;
        break;
      default:
        break;
    }
    EXPECT_EQ(c.active, active);
    EXPECT_EQ(c.degenerate, degenerate);
    EXPECT_EQ(c.inactive, n - active - degenerate);
    EXPECT_EQ(c.negative, 0);
  });
}

TEST_P(Factory, BoundsAreReachedAQuarterEach) {
  for_each([](const KnownProblem& p) {
    EXPECT_EQ(p.lcp().boxed(), p.family == Family::boxed || p.family == Family::boxed_deficient);
    if (!p.lcp().boxed()) return;
    Eigen::Index between = 0, low = 0, high = 0, unbounded = 0, negative = 0;
    for (Eigen::Index i = 0; i < p.b.size(); ++i) {
      low += p.z[i] == p.lower[i] && p.w[i] > 0;
      high += p.z[i] == p.upper[i] && p.w[i] < 0;
      between += std::isfinite(p.upper[i]) && p.lower[i] < p.z[i] && p.z[i] < p.upper[i] && p.w[i] == 0;
      unbounded += std::isinf(p.upper[i]) && std::isinf(p.lower[i]) && p.w[i] == 0;
      negative += p.z[i] < 0;
    }
    for (const Eigen::Index kind : {between, low, high, unbounded}) EXPECT_EQ(kind, p.b.size() / 4);
    EXPECT_GT(negative, low);  // some of the others, too
  });
}

// Rows and columns scaled to a diagonal of 1: ranks and signs are then visible through masses of any ratio.
MatX scaled(const MatX& A) {
  const VecX d = A.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  return d.asDiagonal() * A * d.asDiagonal();
}

TEST_P(Factory, MatrixIsWhatIsClaimed) {
  for_each([](const KnownProblem& p) {
    const MatX A = scaled(p.A);
    const auto n = static_cast<double>(p.b.size());
    EXPECT_EQ(p.symmetric, p.A == p.A.transpose());
    if (p.semidefinite) {
      const Eigen::SelfAdjointEigenSolver<MatX> eigen(0.5 * (A + A.transpose()), Eigen::EigenvaluesOnly);
      EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-15 * n * eigen.eigenvalues().maxCoeff());
    }
    if (p.p_matrix && p.symmetric) {
      EXPECT_TRUE(Eigen::LLT<MatX>(A).info() == Eigen::Success);
    }
    if (A.isLowerTriangular(0) || A.isUpperTriangular(0)) {  // Csizmadia's inverse grows like 2^n
      EXPECT_GT(p.A.diagonal().minCoeff(), 0);
      EXPECT_EQ(p.rank, p.b.size());
      return;
    }
    if (p.rank == 0) return;
    const VecX s = Eigen::JacobiSVD<MatX>(A).singularValues();
    const Eigen::Index rank = (s.array() > 1e-15 * n * s[0]).count();
    if (p.family == Family::ball_heap || p.family == Family::box_heap) {
      EXPECT_LE(rank, p.rank);
    } else if (p.condition <= 1e9 && p.family != Family::hilbert) {
      EXPECT_EQ(rank, p.rank);
    }
    if (p.condition > 0) {
      const VecX given = Eigen::JacobiSVD<MatX>(p.A).singularValues();
      EXPECT_NEAR(given[0] / given[given.size() - 1] / p.condition, 1, 0.1);
    }
  });
}

TEST_P(Factory, CertificatesProveThatThereIsNoAnswer) {
  for_each([](const KnownProblem& p) {
    if (p.solvable) return;
    EXPECT_GE(p.certificate.minCoeff(), 0);
    EXPECT_EQ((p.A.transpose() * p.certificate).cwiseAbs().maxCoeff(), 0);  // whole numbers: exactly
    EXPECT_LT(p.b.dot(p.certificate), 0);
  });
}

TEST_P(Factory, TheSeedDecides) {
  const KnownProblem a = make_problem(GetParam(), 16, 5), b = make_problem(GetParam(), 16, 5),
                     c = make_problem(GetParam(), 16, 6);
  EXPECT_TRUE(a.A == b.A && a.b == b.b && a.z == b.z && a.w == b.w);
  const bool fixed = GetParam() >= Family::murty && GetParam() <= Family::csizmadia_reversed;
  EXPECT_EQ(fixed, a.b == c.b);
}

TEST_P(Factory, RefusesSizesThatItCannotMake) {
  EXPECT_THROW(make_problem(GetParam(), 3, 1), std::invalid_argument);
  EXPECT_THROW(make_problem(GetParam(), 10'001, 1), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Families, Factory, testing::ValuesIn(kFamilies),
                         [](const auto& family) { return std::string(name(family.param)); });

}  // namespace
}  // namespace fc::lcp

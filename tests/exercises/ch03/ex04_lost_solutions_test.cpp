// Exercise 3.4. Planted answers, every active set tried, and certificates that are multiplied out.
#include "ex04_lost_solutions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "ch03_impulse_lcp/problem_factory.hpp"

namespace {

using fc::MatX;
using fc::VecX;
using fc::exercises::drive_all;
using fc::exercises::Driven;
using fc::lcp::Status;

constexpr int kPlenty = 500;  // pivots; none of these problems takes 50

std::string words(const MatX& A, const VecX& b, const Driven& got) {
  std::ostringstream out;
  out << "status " << fc::lcp::name(got.status) << ", z = (" << got.z.transpose() << ") N s, for b = ("
      << b.transpose() << ") m/s and A, 1/kg, =\n"
      << A << "\n";
  return out.str();
}
void expect_solved(const MatX& A, const VecX& b, const char* meaning) {
  const Driven got = drive_all(A, b, kPlenty);
  ASSERT_EQ(got.status, Status::solved) << words(A, b, got) << meaning;
  ASSERT_EQ(got.z.size(), b.size()) << words(A, b, got) << "an impulse for each row";
  const VecX w = fc::lcp::evaluate(A, b, got.z);
  ASSERT_TRUE(fc::lcp::acceptable({A, b}, got.z, w))
      << words(A, b, got) << "it says solved, but w = (" << w.transpose() << ") m/s\n"
      << meaning;
}
void expect_no_solution(const MatX& A, const VecX& b, const char* meaning) {
  const Driven got = drive_all(A, b, kPlenty);
  ASSERT_EQ(got.status, Status::no_solution) << words(A, b, got) << meaning;
  ASSERT_EQ(got.certificate.size(), b.size()) << "a certificate has a number for each row";
  ASSERT_GE(got.certificate.minCoeff(), 0)
      << "a certificate has no negative number: " << got.certificate.transpose();
  ASSERT_TRUE(fc::lcp::certifies_no_solution({A, b}, got.certificate))
      << words(A, b, got) << "y = (" << got.certificate.transpose() << ") proves nothing: A y = ("
      << (A * got.certificate).transpose() << "), b'y = " << b.dot(got.certificate) << "\n"
      << meaning;
}

TEST(Ex04LostSolutions, ThreeBallsInARow) {
  const MatX A{{2, -1}, {-1, 2}};
  const VecX b{{-2, 0}};
  const Driven got = drive_all(A, b, kPlenty);
  ASSERT_EQ(got.status, Status::solved) << words(A, b, got) << "the chapter's example, which has a solution";
  EXPECT_NEAR(got.z[0], 4. / 3, 1e-14) << "N s: the chapter's example by hand";
  EXPECT_NEAR(got.z[1], 2. / 3, 1e-14) << "N s: the chapter's example by hand";
  EXPECT_EQ(got.pivots, 2) << "pivots: each row enters once";
  expect_solved(A, VecX{{-2, -2}}, "the second row still waits for its turn while the first is driven");
}

TEST(Ex04LostSolutions, ATieDoesNotHideTheSolution) {
  expect_solved(
      MatX{{1, -1}, {-1, 1}}, VecX{{1, -1}},
      "a ball between two walls: when it no longer approaches the one, it just reaches the other, and "
      "all is well");
  expect_solved(MatX{{1, -1, 0}, {-1, 1, 0}, {0, 0, 1}}, VecX{{1, -1, -3}},
                "the same, and something else beside it");
  expect_solved(MatX{{1, -1, 1}, {-1, 1, -1}, {1, -1, 1}}, VecX{{2, -2, 2}}, "a tie of two walls");
}

TEST(Ex04LostSolutions, TwoWallsThatWantDifferentThingsAreProvedImpossible) {
  expect_no_solution(
      MatX{{1, -1}, {-1, 1}}, VecX{{1, -2}},
      "one wall sends the ball back at 2 m/s, the other allows 1 m/s; to say solved would leave the "
      "ball inside a wall");
  expect_no_solution(MatX{{0, 0}, {0, 2}}, VecX{{-1, -2}}, "two walls approach, and no impulse moves walls");
  expect_no_solution(MatX{{2, 0, 0}, {0, 1, -1}, {0, -1, 1}}, VecX{{-1, 1, -2}},
                     "what is possible in the first row does not help the two others");
}

TEST(Ex04LostSolutions, ARowLeavesTheBasisAgain) {
  const MatX A{{10, 0, 9}, {0, 10, 3}, {9, 3, 10}};
  const VecX b{{-1, -1, -3}};
  const Driven got = drive_all(A, b, kPlenty);
  expect_solved(A, b, "the third push opens the first contact, which must neither pull nor stay");
  EXPECT_EQ(got.z[0], 0) << "N s: the first contact has opened";
  EXPECT_GE(got.pivots, 4) << "pivots: three rows enter, and one leaves";
}

TEST(Ex04LostSolutions, HeavyAndLightBodiesAreSolvedAlike) {
  const MatX A{{2, -1}, {-1, 2}}, walls{{1, -1}, {-1, 1}};
  const VecX b{{-2, 0}}, apart{{1, -2}}, tie{{1, -1}};
  for (const double mass : {0x1p-40, 0x1p-20, 0x1p20, 0x1p40})
    for (const double speed : {0x1p-40, 1.0, 0x1p40}) {
      expect_solved(A / mass, b * speed,
                    "three balls of other masses, at another speed: nothing else is different");
      expect_solved(walls / mass, tie * speed, "a tie is a tie in any unit");
      expect_no_solution(walls / mass, apart * speed, "impossible in any unit");
    }
}

TEST(Ex04LostSolutions, TheLimitIsNoSolution) {
  const MatX A = 2 * MatX::Identity(6, 6);
  const VecX b = -VecX::Ones(6);
  for (const int most : {0, 1, 5}) {
    const Driven got = drive_all(A, b, most);
    EXPECT_EQ(got.status, Status::limit) << "six rows take six pivots, and " << most << " were allowed; rows "
                                         << "that still approach are neither solved nor impossible";
    EXPECT_LE(got.pivots, most) << "pivots: more than were allowed";
  }
  EXPECT_EQ(drive_all(A, b, 6).status, Status::solved)
      << "solved: six rows take six pivots, and six were allowed";
}

TEST(Ex04LostSolutions, NothingToDo) {
  const Driven got = drive_all(MatX{{0, 0}, {0, 1}}, VecX{{0, 3}}, 0);
  EXPECT_EQ(got.status, Status::solved) << "solved: nothing approaches, from the start";
  EXPECT_EQ(got.z.size(), 2) << "impulses: one for each row, also where all are 0";
  EXPECT_EQ(got.z.norm(), 0) << "N s: no push without an approach";
  EXPECT_EQ(drive_all(MatX(0, 0), VecX(0), 0).status, Status::solved) << "solved: there are no rows at all";
}

// Every symmetric G'G with whole G of few columns, and every active set: no solution is missed, none
// invented.
TEST(Ex04LostSolutions, SmallWholeNumbersWithTiesEverywhere) {
  std::mt19937_64 random(11);
  int without = 0, with = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int n = 2 + trial % 4, rank = 1 + trial % 3;
    MatX G(rank, n);
    VecX b(n);
    for (int i = 0; i < n; ++i) {
      b[i] = static_cast<double>(random() % 5) - 2;
      for (int k = 0; k < rank; ++k) G(k, i) = static_cast<double>(random() % 3) - 1;
    }
    const MatX A = G.transpose() * G;
    // A solution exists if some set of rows with a regular block has one (whole numbers: no doubt at 1e-6).
    bool exists = false;
    for (int set = 0; set < 1 << n && !exists; ++set) {
      std::vector<int> rows;
      for (int i = 0; i < n; ++i)
        if (set >> i & 1) rows.push_back(i);
      VecX z = VecX::Zero(n);
      if (!rows.empty()) {
        const MatX block = A(rows, rows);
        const VecX part = b(rows);
        if (block.determinant() < 0.5) continue;
        z(rows) = -block.inverse() * part;
      }
      exists = z.minCoeff() >= -1e-6 && (A * z + b).minCoeff() >= -1e-6;
    }
    (exists ? with : without) += 1;
    if (exists)
      expect_solved(A, b, "one of the active sets solves it");
    else
      expect_no_solution(A, b, "no active set solves it");
    if (HasFatalFailure()) return;
  }
  ASSERT_GT(with, 500) << "problems with a solution, of the test itself";
  ASSERT_GT(without, 500) << "problems without a solution, of the test itself";
}

TEST(Ex04LostSolutions, TheChaptersFamilies) {
  using fc::lcp::Family;
  for (const Family family : {Family::random_spd, Family::degenerate, Family::rank_deficient,
                              Family::duplicate_contacts, Family::stack, Family::infeasible})
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const fc::lcp::KnownProblem problem = fc::lcp::make_problem(family, 12, seed);
      const std::string name(fc::lcp::name(family));
      if (problem.solvable)
        expect_solved(problem.A, problem.b, name.c_str());
      else
        expect_no_solution(problem.A, problem.b, name.c_str());
      if (HasFatalFailure()) return;
    }
}

}  // namespace

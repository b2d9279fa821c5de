// Exercise 3.1. Whole numbers, so that ties are ties; theorems and the chapter's solver as oracles.
#include "ex01_two_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace {

using fc::exercises::Answer;
using fc::exercises::Mat2;
using fc::exercises::solve_two;
using fc::exercises::Vec2;
using Answers = std::vector<Answer>;

// An answer is made of quotients that are rounded once: half a unit in the last place.
constexpr double kOnce = 1.2e-16;

Mat2 matrix(double a, double b, double c, double d) {
  Mat2 m;
  m << a, b, c, d;
  return m;
}
std::string words(const Mat2& A, const Vec2& b) {
  std::ostringstream out;
  out << "A = [" << A.row(0) << "; " << A.row(1) << "] 1/kg, b = (" << b.transpose() << ") m/s";
  return out.str();
}
std::string words(const Answers& answers) {
  std::ostringstream out;
  out << answers.size() << (answers.size() == 1 ? " answer:" : " answers:");
  for (const Answer& a : answers) out << " z = (" << a.z.transpose() << ")";
  return out.str();
}
bool near(const Vec2& x, const Vec2& y) {
  return std::abs(x[0] - y[0]) <= kOnce * std::abs(y[0]) && std::abs(x[1] - y[1]) <= kOnce * std::abs(y[1]);
}
// The answers are these, in any order.
void expect_answers(const Mat2& A, const Vec2& b, const Answers& expected, const char* meaning) {
  const Answers got = solve_two(A, b);
  EXPECT_EQ(got.size(), expected.size())
      << words(A, b) << ": expected " << words(expected) << "; got " << words(got) << "\n"
      << meaning;
  for (const Answer& e : expected)
    EXPECT_TRUE(std::any_of(got.begin(), got.end(),
                            [&](const Answer& g) { return near(g.z, e.z) && near(g.w, e.w); }))
        << words(A, b) << ": no answer with the impulses (" << e.z.transpose() << ") N s and w = ("
        << e.w.transpose() << ") m/s among " << words(got) << "\n"
        << meaning;
}

TEST(Ex01TwoContacts, ThreeBallsInARow) {
  expect_answers(matrix(2, -1, -1, 2), {-2, 0}, {{{4. / 3, 2. / 3}, {0, 0}}},
                 "the chapter's example: both contacts push, though only one approaches");
}

TEST(Ex01TwoContacts, NobodyPushesWhereNothingApproaches) {
  expect_answers(matrix(2, -1, -1, 2), {0, 3}, {{{0, 0}, {0, 3}}}, "no impulse without an approach");
}

TEST(Ex01TwoContacts, OneContactTearsTheOtherOpen) {
  expect_answers(
      matrix(2, 1, 1, 2), {-4, -1}, {{{2, 0}, {0, 1}}},
      "both approach, but the first push alone opens the second contact, which must not pull it back");
  expect_answers(matrix(2, 1, 1, 2), {-1, -4}, {{{0, 2}, {1, 0}}}, "the same, the other way round");
}

TEST(Ex01TwoContacts, ATieIsOneAnswer) {
  expect_answers(matrix(2, -1, -1, 2), {-2, 1}, {{{1, 0}, {0, 0}}},
                 "the second contact neither pushes nor opens: that is one answer, not one of each kind");
  expect_answers(matrix(2, -1, -1, 2), {0, 0}, {{{0, 0}, {0, 0}}}, "nothing moves, nothing pushes");
}

TEST(Ex01TwoContacts, TheSameContactTwice) {
  const Mat2 A = matrix(1, 1, 1, 1);
  expect_answers(A, {-3, -3}, {{{3, 0}, {0, 0}}, {{0, 3}, {0, 0}}},
                 "A is singular: the two share 3 N s in any way, and the ends of that line are the answers");
  expect_answers(A, {-3, -2}, {{{3, 0}, {0, 1}}}, "the one that asks for more gets it, and opens the other");
}

TEST(Ex01TwoContacts, ABallBetweenTwoWalls) {
  const Mat2 A = matrix(1, -1, -1, 1);
  expect_answers(A, {1, -1}, {{{0, 1}, {0, 0}}},
                 "a tie, on a singular matrix: one wall pushes until the other is just reached");
  expect_answers(A, {1, -2}, {},
                 "one wall wants the ball back at 2 m/s, the other allows 1 m/s: no impulse serves both");
}

TEST(Ex01TwoContacts, AContactThatNothingCanMove) {
  expect_answers(matrix(0, 0, 0, 2), {0, -1}, {{{0, 0.5}, {0, 0}}}, "the first contact is between two walls");
  expect_answers(matrix(0, 0, 0, 2), {-1, 0}, {}, "two walls that approach each other cannot be stopped");
  expect_answers(matrix(0, 0, 0, 0), {1, 2}, {{{0, 0}, {1, 2}}}, "nothing approaches, nothing has to move");
}

TEST(Ex01TwoContacts, AMatrixOfNoFrictionlessWorld) {
  expect_answers(matrix(1, 2, 2, 1), {-1, -1},
                 {{{1, 0}, {0, 1}}, {{0, 1}, {1, 0}}, {{1. / 3, 1. / 3}, {0, 0}}},
                 "its determinant is negative: three different futures");
  expect_answers(matrix(-1, 0, 0, -1), {1, 1},
                 {{{0, 0}, {1, 1}}, {{1, 0}, {0, 1}}, {{0, 1}, {1, 0}}, {{1, 1}, {0, 0}}},
                 "a push that pulls (friction can do that): four futures");
}

TEST(Ex01TwoContacts, ATieIsDecidedBeforeDividing) {
  // 1/49 is rounded, and 49 times that is less than 1.
  expect_answers(matrix(49, 49, 49, 49), {-1, -1}, {{{1. / 49, 0}, {0, 0}}, {{0, 1. / 49}, {0, 0}}},
                 "a ball of 1/49 kg, the same contact twice: the rounded impulse leaves it approaching by "
                 "1e-16 m/s, and a sign taken there loses the answer");
  expect_answers(matrix(49, -49, -49, 49), {-1, 1}, {{{1. / 49, 0}, {0, 0}}}, "the same, between two walls");
}

// For a P-matrix (all principal minors positive) there is exactly one solution, whatever b is.
TEST(Ex01TwoContacts, PMatricesHaveOneAnswer) {
  int cases = 0;
  for (int i = 0; i < 3 * 7 * 7 * 3; ++i) {
    const Mat2 A = matrix(1 + i % 3, i / 3 % 7 - 3, i / 21 % 7 - 3, 1 + i / 147);
    if (A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0) <= 0) continue;
    for (int k = 0; k < 81; ++k, ++cases) {
      const Vec2 b(k % 9 - 4, k / 9 - 4);
      const Answers got = solve_two(A, b);
      ASSERT_EQ(got.size(), 1U) << words(A, b) << ": expected one answer, got " << words(got)
                                << "\nall principal minors are positive: one future, whatever the velocities";
      const Vec2 &z = got[0].z, &w = got[0].w;
      ASSERT_LE((A * z + b - w).norm(), 1e-14) << words(A, b) << ": w, m/s, is not what these impulses do";
      ASSERT_TRUE(z.minCoeff() >= 0 && w.minCoeff() >= 0 && z[0] * w[0] == 0 && z[1] * w[1] == 0)
          << words(A, b) << ": z = (" << z.transpose() << ") N s and w = (" << w.transpose()
          << ") m/s; a contact pushes, or it opens, and never pulls";
    }
  }
  ASSERT_GT(cases, 10000) << "cases, of the test itself";
}

TEST(Ex01TwoContacts, AgreesWithTheChapterOnEverySemidefiniteMatrix) {
  int without = 0;
  for (int i = 0; i < 5 * 9 * 5; ++i) {
    const double c = i / 5 % 9 - 4;
    const Mat2 A = matrix(i % 5, c, c, i / 45);
    if (A.determinant() < 0) continue;
    for (int k = 0; k < 49; ++k) {
      const Vec2 b(k % 7 - 3, k / 7 - 3);
      const fc::MatX full_A = A;
      const fc::VecX full_b = b;
      const fc::lcp::LcpResult oracle = fc::lcp::solve({full_A, full_b});
      const Answers got = solve_two(A, b);
      without += got.empty();
      ASSERT_EQ(got.empty(), oracle.status == fc::lcp::Status::no_solution)
          << words(A, b) << ": got " << words(got) << ", but the chapter's solver says "
          << fc::lcp::name(oracle.status);
      for (const Answer& answer : got)
        ASSERT_LE((answer.w - oracle.w).norm(), 1e-14)
            << words(A, b) << ": w = (" << answer.w.transpose() << ") m/s, expected (" << oracle.w.transpose()
            << "): the velocities after an impact are unique, whatever the impulses are";
    }
  }
  ASSERT_GT(without, 100) << "problems without a solution, of the test itself";
}

// Two walls that open at 120 degrees: their normals are 60 degrees apart, and pushes help each other.
TEST(Ex01TwoContacts, ABallThrownIntoACorner) {
  fc::RigidBody ball;
  ball.set_mass(fc::sphere_mass(0.5, 6 / M_PI));  // 1 kg
  ball.velocity = {-1, -3, 0};
  const std::vector<fc::RigidBody> bodies{{}, ball};
  const fc::Vec3 floor(0, 1, 0), wall(std::sqrt(0.75), 0.5, 0);
  const std::vector<fc::lcp::Contact> contacts{{0, 1, -0.5 * floor, floor, 0, 0.5},
                                               {0, 1, -0.5 * wall, wall, 0, 0.5}};
  const fc::lcp::ImpactProblem problem = fc::lcp::assemble(bodies, contacts);
  const Answers got = solve_two(problem.A, problem.b);
  ASSERT_EQ(got.size(), 1U) << words(got) << " N s for a ball of 1 kg in a corner; expected one";
  // v = (-3, -0.5 sqrt(3) - 1.5), b = 1.5 v; A = [1 1/2; 1/2 1]; z = A^-1 (-b).
  const double b0 = 4.5, b1 = 1.5 * (std::sqrt(0.75) + 1.5);
  const Vec2 z((b0 - b1 / 2) / 0.75, (b1 - b0 / 2) / 0.75);
  EXPECT_LE((got[0].z - z).norm(), 1e-14)
      << "impulses in N s: expected (" << z.transpose() << "), got (" << got[0].z.transpose()
      << "): each wall must throw the ball back with half the speed at which it came";
}

}  // namespace

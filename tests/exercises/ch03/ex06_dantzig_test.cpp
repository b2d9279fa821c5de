// Exercise 3.6. First by hand, then against the chapter's fast Dantzig on problems whose answers are known.
#include "ex06_dantzig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/problem_factory.hpp"

namespace {

using fc::MatX;
using fc::VecX;
using fc::lcp::LcpResult;
using fc::lcp::Status;
using fc::mine::dantzig;

// What there was to see; the sentence that helps stands before it.
std::string words(const MatX& A, const VecX& b, const LcpResult& got) {
  std::ostringstream out;
  out << "\nIt returned z = (" << got.z.transpose() << ") N s, for b = (" << b.transpose()
      << ") m/s and A, 1/kg, =\n"
      << A;
  return out.str();
}

std::string how_it_ended(const LcpResult& got) {
  std::string how = "dantzig() says solved";
  if (got.status == Status::limit) how = "dantzig() gave up (limit)";
  if (got.status == Status::no_solution) how = "dantzig() says that there is no solution";
  return how + " after " + std::to_string(got.pivots) + (got.pivots == 1 ? " pivot" : " pivots");
}

// Solves, and holds the result against the contract. `meaning`: what a failure would mean.
LcpResult expect_solved(const MatX& A, const VecX& b, const std::string& meaning) {
  LcpResult got = dantzig(A, b, 0);
  if (got.z.size() != b.size() || got.w.size() != b.size()) {
    ADD_FAILURE() << "z must have an impulse for each row, and w = A z + b a speed: " << b.size()
                  << " each, not " << got.z.size() << " and " << got.w.size();
    got.z = got.w = VecX::Constant(b.size(), std::nan(""));
  } else if (got.status != Status::solved) {
    ADD_FAILURE() << how_it_ended(got) << ": " << meaning << words(A, b, got);
  } else if (!fc::lcp::acceptable({A, b}, got.z, got.w)) {
    ADD_FAILURE() << how_it_ended(got) << ", but is wrong: " << meaning << words(A, b, got)
                  << "\nBut A z + b = (" << fc::lcp::evaluate(A, b, got.z).transpose() << ") m/s, its w = ("
                  << got.w.transpose() << ") m/s; every z and w must be >= 0, and one of the two 0";
  }
  return got;
}

void expect_no_solution(const MatX& A, const VecX& b, const char* meaning) {
  const LcpResult got = dantzig(A, b, 0);
  if (got.status != Status::no_solution)
    FAIL() << how_it_ended(got) << ", but there is no solution: " << meaning << words(A, b, got);
  if (got.certificate.size() != b.size())
    FAIL() << "a certificate has a number for each row: " << b.size() << ", not " << got.certificate.size();
  if (!(got.certificate.minCoeff() >= 0 && fc::lcp::certifies_no_solution({A, b}, got.certificate)))
    FAIL() << "the certificate y = (" << got.certificate.transpose() << ") proves nothing: " << meaning
           << "\nIt must be >= 0, A y = (" << (A * got.certificate).transpose()
           << ") must be 0, and b'y = " << b.dot(got.certificate) << " negative" << words(A, b, got);
}

TEST(Ex06Dantzig, ThreeBallsOfTheText) {
  const MatX A{{1.5, -0.5}, {-0.5, 1.5}};
  const VecX b{{-3, -1.5}};
  const LcpResult got = expect_solved(A, b, "the text's worked example");
  EXPECT_NEAR(got.z[0], 21. / 8, 1e-14) << "N s: the left contact, by hand";
  EXPECT_NEAR(got.z[1], 15. / 8, 1e-14) << "N s: the right contact, by hand";
  EXPECT_EQ(got.pivots, 2) << "pivots: each row enters once";
}

TEST(Ex06Dantzig, WhoDoesNotApproachIsNotPushed) {
  const LcpResult got = expect_solved(MatX{{1, 0.5}, {0.5, 1}}, VecX{{0, 2}}, "nothing approaches");
  EXPECT_EQ(got.z, VecX::Zero(2)) << "N s: an impulse without an approach";
  EXPECT_EQ(got.pivots, 0) << "pivots: there is nothing to do";
  expect_solved(MatX(0, 0), VecX(0), "no contacts: nothing is wrong");
}

TEST(Ex06Dantzig, APushThatIsNoLongerNeededEnds) {
  const double inertia = 9.04 / 12;
  const auto entry = [&](double x, double y) { return 1 + x * y / inertia; };
  const MatX A{{entry(-1.3, -1.3), entry(-1.3, -0.4)}, {entry(-0.4, -1.3), entry(-0.4, -0.4)}};
  const VecX b{{-1.5, -1.5}};
  const LcpResult got =
      expect_solved(A, b, "the plank on two posts: while the second post is driven, the first is relieved");
  EXPECT_EQ(got.z[0], 0)
      << "N s: the first post would have to pull the plank down; a row whose z has fallen to 0 leaves the basis";
  EXPECT_NEAR(got.z[1], 1.5 / A(1, 1), 1e-14) << "N s: then the second post bears all";
  EXPECT_EQ(got.pivots, 3) << "pivots: in, out, in";
}

TEST(Ex06Dantzig, ARowOutsideComesIn) {
  const MatX A{{2, -1, 0}, {-1, 2, -1}, {0, -1, 2}};
  const LcpResult got =
      expect_solved(A, VecX{{1, 1, -6}}, "a push at the last contact makes the two before it approach");
  EXPECT_GT(got.z[0], 0)
      << "N s: w of a row outside the basis has fallen to 0 during the drive; the row enters";
}

TEST(Ex06Dantzig, ATieDoesNotHideTheSolution) {
  expect_solved(
      MatX{{1, -1}, {-1, 1}}, VecX{{1, -1}},
      "a ball between two walls: when it no longer approaches the one, it just reaches the other, and all is well");
  expect_solved(MatX{{1, -1, 0}, {-1, 1, 0}, {0, 0, 1}}, VecX{{1, -1, -3}},
                "the same, and something else beside it");
}

TEST(Ex06Dantzig, ARowThatStillApproachesStopsNothing) {
  expect_solved(
      MatX{{5, 4, 3}, {4, 5, 2}, {3, 2, 2}}, VecX{{-9, -9, -27}},
      "row 1 enters at z_1 = 9/5; then row 2 is driven, and w_3 falls from -108/5 to -22. Row 3 waits for its "
      "turn: it stops nothing, row 2 enters, and z = (1, 1, 0)");
  expect_solved(
      MatX{{2, 1, -1}, {1, 2, -1}, {-1, -1, 1}}, VecX{{0, -1, -1}},
      "row 2 is driven, and w_3 falls from -1 to -3/2. Row 3 waits for its turn: it stops nothing, and row 2 enters "
      "at z_2 = 1/2");
}

TEST(Ex06Dantzig, TheDrivenRowWinsATie) {
  expect_solved(
      MatX{{2, -1, 0}, {-1, 2, 2}, {0, 2, 4}}, VecX{{2, -4, -6}},
      "row 2 is driven; at z_2 = 2 its w reaches 0, and so does w_1. Row 2 must enter: then the push at row 3 "
      "relieves it, and z = (0, 1, 1)");
  expect_solved(
      MatX{{2, 1, -1}, {1, 1, 0}, {-1, 0, 1}}, VecX{{-1, -1, -1}},
      "row 1 enters at z_1 = 1/2; then row 2 is driven, and at z_2 = 1 its w reaches 0, and so does z_1. Row 2 "
      "must enter, and row 1 stays: then row 3 is driven, and z = (2, 0, 3)");
}

// What is 1 or 2 on paper may end in another last bit when A is divided by the mass.
TEST(Ex06Dantzig, ATieIsATieUpToRoundOff) {
  for (int mass = 1; mass <= 30 && !HasFailure(); ++mass) {
    const std::string bodies = "bodies of " + std::to_string(mass) +
                               " kg: a tie on paper, though the two steps may differ in the last bit. ";
    expect_solved(MatX{{1, 1, 0}, {1, 3, 1}, {0, 1, 1}} / mass, VecX{{-1, -3, -2}},
                  bodies +
                      "While row 2 is driven, w_2 and z_1 reach 0 at the same step; row 2 must enter, "
                      "and row 1 stays");
    expect_solved(MatX{{1, -1, 1}, {-1, 2, -3}, {1, -3, 5}} / mass, VecX{{-1, 0, 1}},
                  bodies +
                      "Row 1 is driven, row 2 enters at once; then w_1 and w_3 reach 0 at the same step, and "
                      "row 1 must enter");
  }
}

// On paper a dependent row never stops a drive. In numbers its change is a last bit, and may be negative.
TEST(Ex06Dantzig, ARowThatDependsOnTheBasisStopsNothing) {
  for (int mass = 1; mass <= 30 && !HasFailure(); ++mass) {
    const std::string bodies = "bodies of " + std::to_string(mass) + " kg: ";
    expect_solved(
        MatX{{3, 2, -1, 1}, {2, 2, -1, 0}, {-1, -1, 1, 0}, {1, 0, 0, 1}} / mass, VecX{{-1, 0, -2, -1}},
        bodies +
            "row 3 is driven last, with rows 1 and 2 in the basis. Row 4 is row 1 less row 2, so w_4 stays "
            "0; what changes it is round-off, and row 4 stops nothing");
    expect_solved(
        MatX{{3, 1, -1, 1}, {1, 3, 1, 1}, {-1, 1, 1, 0}, {1, 1, 0, 1}} / mass, VecX{{-3, -3, 0, -3}},
        bodies +
            "row 4 is driven last, with rows 1 and 2 in the basis. Row 3 is half of row 2 less row 1, so w_3 "
            "stays 0; what changes it is round-off, and row 3 stops nothing");
  }
}

TEST(Ex06Dantzig, TwoWallsThatContradictEachOther) {
  expect_no_solution(
      MatX{{1, -1}, {-1, 1}}, VecX{{-2, 1}},
      "one wall sends the ball back at 2 m/s, the other allows 1 m/s; the drive that nothing stops is the proof");
  expect_no_solution(MatX{{0, 0}, {0, 2}}, VecX{{-1, -2}}, "two walls approach, and no impulse moves walls");
}

TEST(Ex06Dantzig, EqualRows) {
  const MatX one = MatX::Ones(4, 4);
  const LcpResult got =
      expect_solved(one, VecX::Constant(4, -2), "one contact, listed four times: A has rank 1");
  EXPECT_NEAR(got.z.sum(), 2, 1e-12) << "N s: who shares the impulse is free, the sum is not";
}

TEST(Ex06Dantzig, OtherUnits) {
  const MatX A{{1.5, -0.5}, {-0.5, 1.5}};
  const VecX b{{-3, -1.5}};
  for (const double factor : {std::ldexp(1.0, -40), std::ldexp(1.0, 40)}) {
    const LcpResult slow =
        expect_solved(A, factor * b, "velocities in another unit: compare w with b, not with 1e-9");
    EXPECT_NEAR(slow.z[0] / factor, 21. / 8, 1e-12)
        << "N s: slow bodies are not bodies at rest; compare w with b, not with 1e-9";
    const LcpResult light =
        expect_solved(factor * A, b, "masses in another unit: what is small depends on the unit of A");
    EXPECT_NEAR(light.z[0] * factor, 21. / 8, 1e-12) << "N s: 'small' depends on the unit of A";
  }
}

TEST(Ex06Dantzig, StopsAtTheLimit) {
  const fc::lcp::KnownProblem p = fc::lcp::make_problem(fc::lcp::Family::random_spd, 12, 1);
  ASSERT_GT(dantzig(p.A, p.b, 0).pivots, 3) << "pivots: twelve rows, most of which push, take more";
  const LcpResult got = dantzig(p.A, p.b, 3);
  if (got.status != Status::limit)
    ADD_FAILURE() << how_it_ended(got)
                  << ", where three are allowed and are not enough: unsolved is not solved";
  EXPECT_LE(got.pivots, 3) << "pivots: the caller allowed three";
}

TEST(Ex06Dantzig, AgreesWithTheFastOne) {
  using fc::lcp::Family;
  for (const Family family :
       {Family::random_spd, Family::degenerate, Family::rank_deficient, Family::duplicate_contacts,
        Family::stack, Family::box_heap, Family::graded, Family::infeasible})
    for (const int n : {8, 20, 40})
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const fc::lcp::KnownProblem p = fc::lcp::make_problem(family, n, seed);
        const LcpResult got = dantzig(p.A, p.b, 0), fast = fc::lcp::solve_dantzig(p.lcp());
        if (got.status != fast.status)
          FAIL()
              << how_it_ended(got) << ", the chapter's fast one: " << fc::lcp::name(fast.status)
              << ". Did a tie, a row that depends on the basis, or one that still waits for its turn lead yours "
                 "astray? Family "
              << family << ", " << n << " rows, seed " << seed;
        if (got.status != Status::solved) continue;
        ASSERT_LE((fc::lcp::evaluate(p.A, p.b, got.z) - fast.w).lpNorm<Eigen::Infinity>(),
                  1e-9 * p.b.lpNorm<Eigen::Infinity>())
            << "m/s: the velocities of family " << family << ", " << n << " rows, seed " << seed
            << "; they are unique";
      }
}

}  // namespace

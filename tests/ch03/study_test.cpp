// The study: what its tables say is consistent, the same in every run but for times, and right where the
// answer is known.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "ch03_impulse_lcp/study/parts.hpp"
#include "tests/support/run_files.hpp"

namespace {

using namespace fc::lcp;
namespace fs = std::filesystem;

fc_test::Outcome study(const std::string& arguments) {
  return fc_test::run("'" FC_BIN_DIR "/ch03_study' " + arguments);
}

class StudyTables : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fc_test::scratch("ch03_study");
    outcome = study("--part all --rows 128 --seeds 1 --quiet --out '" + folder.string() + "'");
  }
  void SetUp() override { ASSERT_EQ(outcome.exit_code, 0) << outcome.err; }
  static fc_test::Table table(const std::string& name) { return fc_test::read_table(folder / name); }
  static inline fs::path folder;
  static inline fc_test::Outcome outcome;
};

std::string text(const fc_test::Table& table, int row, const std::string& column) {
  return table.cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(table.column(column))];
}

// The small heaps, chains and stacks of the study are all Dantzig's to solve, whatever their masses are.
TEST_F(StudyTables, DantzigIsExactOnEveryFamily) {
  for (const char* file : {"accuracy.csv", "growth.csv", "profiles.csv"}) {
    const fc_test::Table t = table(file);
    std::set<std::string> families;
    for (int row = 0; row < t.rows(); ++row) {
      if (text(t, row, "method") != "dantzig") continue;
      families.insert(text(t, row, "family"));
      SCOPED_TRACE(std::string(file) + ", row " + std::to_string(row));
      EXPECT_LE(t.at(row, "residual"), 1e-13);
      if (std::string(file) == "profiles.csv") {
        EXPECT_EQ(t.at(row, "good"), 1);
      } else {
        EXPECT_EQ(t.at(row, "solved"), t.at(row, "problems"));
      }
      if (std::string(file) == "accuracy.csv") {
        EXPECT_LE(t.at(row, "error"), 1e-12);
      }
    }
    EXPECT_GE(families.size(), 2u) << file;
  }
}

TEST_F(StudyTables, MoreTimeNeverBuysLess) {
  const fc_test::Table t = table("budget.csv");
  ASSERT_GE(t.rows(), 12);  // 6 families, 2 sizes
  for (int row = 0; row < t.rows(); ++row) {
    EXPECT_LE(t.at(row, "residual_at_0"), 1);
    EXPECT_LE(t.at(row, "residual_in_100000_ns"), t.at(row, "residual_at_0"));
    EXPECT_LE(t.at(row, "residual_in_1000000_ns"), t.at(row, "residual_in_100000_ns"));
    EXPECT_LE(t.at(row, "residual_in_10000000_ns"), t.at(row, "residual_in_1000000_ns"));
  }
}

// One sweep or step solves no 32 rows; hundreds of them, or the last one, do.
TEST_F(StudyTables, CurvesFallToAnAnswer) {
  const fc_test::Table t = table("accuracy.csv");
  for (const std::string method : {"pgs", "interior_point"}) {
    std::vector<double> curve;
    for (int row = 0; row < t.rows(); ++row)
      if (text(t, row, "method") == method && text(t, row, "family") == "random_spd" &&
          t.at(row, "rows") == 32)
        curve.push_back(t.at(row, "residual"));
    ASSERT_GE(curve.size(), 5u) << method;
    EXPECT_GT(curve.front(), 1e-3) << method;
    EXPECT_LE(curve.back(), 1e-12) << method;
  }
}

// A method that is secretly another one would need the same work everywhere.
TEST_F(StudyTables, MethodsAreDifferent) {
  const fc_test::Table t = table("profiles.csv");
  std::map<std::string, std::map<std::string, double>> work;  // method, problem
  for (int row = 0; row < t.rows(); ++row)
    work[text(t, row, "method")][text(t, row, "family") + text(t, row, "rows")] = t.at(row, "work");
  EXPECT_TRUE(work.contains("dantzig"));
  for (auto a = work.begin(); a != work.end(); ++a)
    for (auto b = std::next(a); b != work.end(); ++b) EXPECT_NE(a->second, b->second) << a->first << b->first;
}

// The best of the rows of accuracy.csv within the time, found again here.
TEST_F(StudyTables, BudgetIsWhatAccuracyReached) {
  const fc_test::Table accuracy = table("accuracy.csv"), budget = table("budget.csv");
  for (int row = 0; row < budget.rows(); ++row) {
    double best = budget.at(row, "residual_at_0");
    for (int k = 0; k < accuracy.rows(); ++k) {
      const bool same = text(accuracy, k, "family") == text(budget, row, "family") &&
                        text(accuracy, k, "rows") == text(budget, row, "rows") &&
                        text(accuracy, k, "method") == text(budget, row, "method");
      if (same && accuracy.at(k, "median_ns") <= 1e6) best = std::min(best, accuracy.at(k, "residual"));
    }
    EXPECT_EQ(budget.at(row, "residual_in_1000000_ns"), best) << row;
  }
}

// The exponent of three points, evenly spaced in log n, is the slope between the first and the last.
TEST_F(StudyTables, ExponentsFitTheGrowth) {
  const fc_test::Table growth = table("growth.csv"), exponents = table("exponents.csv");
  ASSERT_GE(exponents.rows(), 2);
  for (int row = 0; row < exponents.rows(); ++row) {
    std::map<int, double> work;
    for (int k = 0; k < growth.rows(); ++k)
      if (text(growth, k, "family") == text(exponents, row, "family") &&
          text(growth, k, "method") == text(exponents, row, "method") &&
          text(growth, k, "target") == text(exponents, row, "target"))
        work[static_cast<int>(growth.at(k, "rows"))] = growth.at(k, "work");
    EXPECT_NEAR(exponents.at(row, "work_exponent"), std::log(work.at(128) / work.at(32)) / std::log(4.0),
                1e-3);
  }
}

TEST_F(StudyTables, AreTheSameInEveryRunButForTimes) {
  const fs::path again = fc_test::scratch("ch03_study_again");
  ASSERT_EQ(study("--part profiles --rows 128 --seeds 1 --quiet --out '" + again.string() + "'").exit_code,
            0);
  EXPECT_EQ(fc_test::without_times(fc_test::read_table(again / "profiles.csv")),
            fc_test::without_times(table("profiles.csv")));
}

TEST(StudyProgram, RefusesWhatItCannotDo) {
  const std::string out = " --quiet --out '" + fc_test::scratch("ch03_study_bad").string() + "'";
  EXPECT_EQ(study("--help").exit_code, 0);
  EXPECT_EQ(study("--part nothing" + out).exit_code, 2);
  EXPECT_EQ(study("--part growth --rows 8" + out).exit_code, 2);
  EXPECT_EQ(study("--part growth --seeds 0" + out).exit_code, 2);
  EXPECT_EQ(study("--part growth --quiet --out /proc/none").exit_code, 2);
}

TEST(StudyTally, CountsWorkInProductsAndTakesMedians) {
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2);
  EXPECT_EQ(products(Method::dantzig, 7, 30), 7);
  EXPECT_EQ(products(Method::interior_point, 7, 30), 70);
  const KnownProblem p = make_problem(Family::random_spd, 8, 1);
  Timed timed;
  timed.result = {Status::solved, p.z, p.w, 0, 4};
  timed.ns = 5;
  Tally tally;
  tally.add(p, timed);
  timed.result.w[0] += 2 * p.b.lpNorm<Eigen::Infinity>();
  timed.result.status = Status::limit;
  tally.add(p, timed);
  timed.result.status = Status::unsuited;  // left out
  tally.add(p, timed);
  EXPECT_EQ(tally.solved, 1);
  EXPECT_EQ(tally.work, (std::vector<double>{4, 4}));
  EXPECT_EQ(tally.error[0], 0);
  EXPECT_DOUBLE_EQ(tally.error[1], 2);
}

}  // namespace

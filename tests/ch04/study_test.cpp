// The study: what its tables say is consistent, the same in every run but for times, and right where the
// answer is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/run_files.hpp"

namespace {

namespace fs = std::filesystem;

fc_test::Outcome study(const std::string& arguments) {
  return fc_test::run("'" FC_BIN_DIR "/ch04_study' " + arguments);
}
std::string text(const fc_test::Table& table, int row, const std::string& column) {
  return table.cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(table.column(column))];
}

class StepStudy : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fc_test::scratch("ch04_study");
    outcome = study("--part all --bodies 100 --repeats 1 --quiet --out '" + folder.string() + "'");
  }
  void SetUp() override { ASSERT_EQ(outcome.exit_code, 0) << outcome.err; }
  static fc_test::Table table(const std::string& name) { return fc_test::read_table(folder / name); }
  static inline fs::path folder;
  static inline fc_test::Outcome outcome;
};

TEST_F(StepStudy, AnImpactAsksAFewPairsHoweverManyBodies) {
  const auto t = table("growth.csv");
  ASSERT_EQ(t.rows(), 9);
  for (int row = 0; row < t.rows(); ++row) {
    EXPECT_GT(t.at(row, "impacts"), 10);
    EXPECT_LE(t.at(row, "queries_per_impact"), 20);
    EXPECT_LE(t.at(row, "energy_drift"), 1e-13);
  }
}

TEST_F(StepStudy, EventsAreAsGoodAsTheirToleranceAtAnyPrice) {
  const auto t = table("bounces.csv");
  double work = 0, best_moreau = 1;
  for (int row = 0; row < t.rows(); ++row) {
    if (text(t, row, "method") == "moreau") {
      best_moreau = std::min(best_moreau, t.at(row, "error"));
      continue;
    }
    EXPECT_LE(t.at(row, "error"), 2 * t.at(row, "knob")) << "m, for a tolerance of " << text(t, row, "knob");
    if (row == 0) work = t.at(row, "work");
    EXPECT_EQ(t.at(row, "work"), work) << "queries do not grow with the accuracy";
  }
  EXPECT_GT(best_moreau, 1e-7) << "m: time stepping is first order";
  EXPECT_LT(best_moreau, 1e-4) << "m, in four million steps";
}

TEST_F(StepStudy, SwitchesThatAskForNothingCostNothing) {
  const auto t = table("switches.csv");
  std::map<std::string, int> rows;
  for (int row = 0; row < t.rows(); ++row) rows[text(t, row, "scene") + ", " + text(t, row, "switch")] = row;
  const int none = rows.at("blocks, none (restitution 1)");
  for (const char* column : {"impacts", "pairs", "queries", "advances", "lcp_rows"})
    EXPECT_EQ(t.at(rows.at("blocks, sleep (nobody sleeps)"), column), t.at(none, column)) << column;
  EXPECT_EQ(t.at(rows.at("blocks, swept detection off"), "impacts"), t.at(none, "impacts"));
  EXPECT_GT(t.at(rows.at("blocks, swept detection off"), "queries"), 100 * t.at(none, "queries"));
  EXPECT_EQ(t.at(rows.at("balls, nothing moves"), "pairs"), 0);
}

TEST_F(StepStudy, EachDigitOfToleranceIsADigitOfTheResult) {
  const auto t = table("trajectories.csv");
  std::map<std::string, double> error;
  for (int row = 0; row < t.rows(); ++row)
    error[text(t, row, "knob") + " " + text(t, row, "value")] = t.at(row, "error");
  EXPECT_LT(error.at("tolerance [m] 1e-8"), 0.1 * error.at("tolerance [m] 1e-6"));
  EXPECT_LT(error.at("tolerance [m] 1e-10"), 0.1 * error.at("tolerance [m] 1e-8"));
  EXPECT_LT(error.at("frames 768"), 1e-4) << "m: the frames have no influence";
  EXPECT_LT(error.at("solver pgs"), 1e-4);
  EXPECT_GT(error.at("motion constant spin"), 0.1) << "m: another world";
}

TEST(StepStudyProgram, RefusesBadOptions) {
  EXPECT_EQ(study("--part nothing --out x").exit_code, 2);
  EXPECT_EQ(study("--part growth").exit_code, 2);
  EXPECT_EQ(study("--part growth --bodies 7 --out x").exit_code, 2);
}

}  // namespace

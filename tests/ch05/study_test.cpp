// The study: its tables are the same in every run but for times, and right where the answer is known; and the time
// stepping that it compares with behaves as described.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "ch05_resting_contact/study/moreau_jean.hpp"
#include "ch05_resting_contact/study/parts.hpp"
#include "tests/support/run_files.hpp"

namespace {

using namespace fc::resting;

// v+ = v- + dt g, then x+ = x + dt v+: what it makes of free fall is known exactly.
TEST(MoreauJean, FallsAsItsFormulaSays) {
  fc::Scene scene = ball_scene();
  scene.envelope.reset();
  fc::world::World world = fc::world::build_world(scene);
  MoreauJean stepper(world, kFrame);
  const int frames = 20;
  for (int k = 0; k < frames; ++k) EXPECT_EQ(stepper.step(world).rows, 0) << "in the air";
  EXPECT_NEAR(world.bodies[1].state.position.z(),
              0.5 + kDrop - 0.5 * kGravity * kFrame * kFrame * frames * (frames + 1), 1e-12);
}

// A stack that touches exactly is supported exactly, and stays.
TEST(MoreauJean, CarriesAStackThatTouches) {
  const StackResult r = measure_stack({.scene = stack_scene(0), .method = Method::moreau}, 1);
  EXPECT_LE(r.force_error, 1e-11);
  EXPECT_LE(r.place_error, 1e-9) << "m";
  EXPECT_EQ(r.run.lost, 0);
}

// First order: the ball comes to rest later than it should, by a few frames.
TEST(MoreauJean, EndsBouncesLate) {
  double last = 1;
  for (const double dt : {1 / 60.0, 1 / 240.0, 1 / 960.0}) {
    const BallResult r = measure_ball({.scene = ball_scene(), .dt = dt, .method = Method::moreau}, 1);
    EXPECT_GT(r.rest_error, 0) << "s";
    EXPECT_LT(r.rest_error, 0.5 * last) << "s: a quarter of the frame";
    last = r.rest_error;
  }
}

// The overlap of faces is measured right, from above and from below zero.
TEST(Facing, SeesGapsOfBothSigns) {
  for (const double gap : {0.02, 1e-6, 0.0, -1e-6, -0.02}) {
    fc::world::World world = fc::world::build_world(stack_scene(0));
    Facing facing(world);
    smallest_gap(facing, world, 0.05);  // the normals
    for (std::size_t k = 1; k < world.bodies.size(); ++k)
      world.bodies[k].state.position.z() += gap * static_cast<double>(k);
    EXPECT_NEAR(smallest_gap(facing, world, 0.05), gap, 1e-12) << "m";
  }
}

class RestStudy : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fc_test::scratch("ch05_study");
    outcome = run("methods", folder);
  }
  void SetUp() override { ASSERT_EQ(outcome.exit_code, 0) << outcome.err; }
  static fc_test::Outcome run(const std::string& part, const std::filesystem::path& out) {
    return fc_test::run("'" FC_BIN_DIR "/ch05_study' --repeats 1 --quiet --part " + part + " --out '" +
                        out.string() + "'");
  }
  static fc_test::Table table(const std::string& name) { return fc_test::read_table(folder / name); }
  static std::string text(const fc_test::Table& t, int row, const std::string& column) {
    return t.cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(t.column(column))];
  }
  static inline std::filesystem::path folder;
  static inline fc_test::Outcome outcome;
};

TEST_F(RestStudy, SaysWhoLosesTimeAndWhoOverlaps) {
  const auto t = table("methods.csv");
  ASSERT_EQ(t.rows(), 12);
  for (int row = 0; row < t.rows(); ++row) {
    const std::string method = text(t, row, "method");
    EXPECT_EQ(t.at(row, "lost") > 0, method == "events") << row;
    if (method == "envelope") {
      EXPECT_GT(t.at(row, "gap"), 0) << "m, row " << row;
    }
  }
  const auto w = table("weights.csv");
  for (int row = 0; row < w.rows(); ++row)
    if (text(w, row, "method") == "envelope") {
      EXPECT_LE(w.at(row, "force_error"), 1e-9) << row;
    }
}

TEST_F(RestStudy, TheEnvelopeIsSecondOrderForABall) {
  const auto t = table("ball.csv");
  std::map<std::string, double> first, last;
  for (int row = 0; row < t.rows(); ++row) {
    first.try_emplace(text(t, row, "method"), t.at(row, "height_error"));
    last[text(t, row, "method")] = t.at(row, "height_error");
  }
  EXPECT_LT(last.at("events"), 1e-7) << "m";
  EXPECT_LT(last.at("envelope"), 1e-3 * first.at("envelope")) << "m, frames of 1/1920 s beside 1/15 s";
  EXPECT_GT(last.at("moreau"), 1e-3 * first.at("moreau"));
}

TEST_F(RestStudy, IsTheSameInEveryRun) {
  const auto again = fc_test::scratch("ch05_study_again");
  ASSERT_EQ(run("methods", again).exit_code, 0);
  for (const char* name : {"methods.csv", "histories.csv", "ball.csv", "weights.csv"}) {
    const auto a = table(name), b = fc_test::read_table(again / name);
    ASSERT_EQ(a.rows(), b.rows()) << name;
    for (int row = 0; row < a.rows(); ++row)
      for (std::size_t column = 0; column < a.columns.size(); ++column)
        if (!a.columns[column].ends_with("_ns")) {
          EXPECT_EQ(a.cells[static_cast<std::size_t>(row)][column],
                    b.cells[static_cast<std::size_t>(row)][column])
              << name << ", row " << row << ", " << a.columns[column];
        }
  }
}

TEST(RestStudyProgram, RefusesBadOptions) {
  for (const char* arguments :
       {"--part nothing --out x", "--part methods", "--part methods --repeats 0 --out x"})
    EXPECT_EQ(fc_test::run(std::string("'" FC_BIN_DIR "/ch05_study' ") + arguments).exit_code, 2)
        << arguments;
}

}  // namespace

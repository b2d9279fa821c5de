// The clear versions of chapter 6 against the fast ones: one contact, islands, and the programs that run on them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "ch06_friction/clear/law.hpp"
#include "cones.hpp"
#include "tests/support/run_files.hpp"

namespace {

using namespace fc;
using namespace fc::friction;
using std::filesystem::path;

// --- one contact ------------------------------------------------------------------------------------------

TEST(Clear, OneContactIsThatOfTheEngine) {
  std::mt19937_64 random(20080117);
  int sticks = 0, slips = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    SCOPED_TRACE(draw);
    const OwnProblem p = random_problem(random, 1, 3 + draw % 2, 0, draw % 3);
    const Mat3 A = p.A;
    const Vec3 q = p.b;
    const double mu = std::pow(10.0, uniform(random, -2, 1)), size = A.cwiseAbs().maxCoeff();
    const clear::Answer answer = clear::solve_contact(A, q, mu);
    const Vec3 fast = OneContact(A, mu).solve(q);
    EXPECT_LE((answer.r - fast).norm() * size, 1e-6 * (q.norm() + fast.norm() * size))
        << "r = " << answer.r.transpose() << " and " << fast.transpose() << " N s";
    const MatX matrix = A;
    const VecX b = q, coefficient = VecX::Constant(1, mu), r = answer.r;
    EXPECT_LE(residual({matrix, b, coefficient}, r, A * answer.r + q), 1e-12);
    sticks += answer.kind == clear::Kind::stick;
    slips += answer.kind == clear::Kind::slip;
    EXPECT_EQ(answer.kind == clear::Kind::open, fast.isZero(0));
  }
  EXPECT_GT(sticks, 500);
  EXPECT_GT(slips, 5000);
}

// --- islands ----------------------------------------------------------------------------------------------

TEST(Clear, SweepsSolveWhatTheEngineSolves) {
  std::mt19937_64 random(20080118);
  int solved = 0;
  for (int draw = 0; draw < 100; ++draw) {
    SCOPED_TRACE(draw);
    const OwnProblem p = random_problem(random, 1 + draw % 6, 12, 0.5);
    VecX r = VecX::Zero(p.b.size());
    int sweeps = 0;
    if (!clear::sweep_contacts(clear::solve_contact, p, r, sweeps)) continue;
    ++solved;
    EXPECT_LE(residual(p, r, p.A * r + p.b), 1e-6);
    EXPECT_LE(energy_change(p, r), 1e-9) << "J";
  }
  EXPECT_GE(solved, 95);
}

// --- the program ------------------------------------------------------------------------------------------

const path kScenes = path(FC_SOURCE_DIR) / "chapters/ch06_friction/scenes";

fc_test::Outcome ran(const path& scene, const path& out, const std::string& options) {
  return fc_test::run(std::string(FC_BIN_DIR) + "/ch06_friction '" + scene.string() + "' --poses --out '" +
                      out.string() + "' " + options);
}

// The largest difference of the bodies' places, m.
double apart(const path& one, const path& other) {
  const fc_test::Table a = fc_test::read_table(one / "poses.csv"),
                       b = fc_test::read_table(other / "poses.csv");
  if (a.rows() != b.rows() || a.rows() == 0) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (int row = 0; row < a.rows(); ++row)
    for (const char* axis : {"px", "py", "pz"})
      worst = std::max(worst, std::abs(a.at(row, axis) - b.at(row, axis)));
  return worst;
}

// In these scenes each contact has one answer, or nothing moves.
TEST(Clear, MovesBodiesAsTheEngineDoes) {
  for (const char* scene : {"slope", "slide", "billiards", "orbit", "card_house"}) {
    const path file = kScenes / (std::string(scene) + ".yaml");
    const std::string shorter = scene == std::string("card_house") ? " --set step.duration=0.5" : "";
    const path fast = fc_test::scratch("fast"), clear = fc_test::scratch("clear");
    ASSERT_EQ(ran(file, fast, "--quiet" + shorter).exit_code, 0) << scene;
    const fc_test::Outcome o = ran(file, clear, "--clear" + shorter);
    ASSERT_EQ(o.exit_code, 0) << scene << ": " << o.err;
    EXPECT_NE(o.out.find("the book's"), std::string::npos) << o.out;
    EXPECT_LE(apart(fast, clear), 1e-7) << "m: " << scene;
    const fc_test::Table steps = fc_test::read_table(clear / "steps.csv");
    for (int row = 0; row < steps.rows(); ++row) {
      EXPECT_EQ(steps.at(row, "max_penetration"), 0) << scene;
      EXPECT_EQ(steps.at(row, "lost_time"), 0) << scene;
    }
  }
}

TEST(Clear, ASceneInWhichNothingRubsIsRefusedInALine) {
  const fc_test::Outcome o =
      ran(kScenes / "slide.yaml", fc_test::scratch("refused"), "--clear --set friction=0");
  EXPECT_EQ(o.exit_code, 2);
  EXPECT_NE(o.err.find("this scene has no friction"), std::string::npos) << o.err;
}

// The book's function, compiled as a learner's is, put where exercises/check.py puts those.
TEST(Clear, MineOnTheBooksPieceWritesTheSameFiles) {
  const path mine = fc_test::scratch("mine");
  const path source = path(FC_SOURCE_DIR) / "README.md";  // any file that does not change meanwhile
  std::filesystem::copy_file(path(FC_BOOK_PIECES) / "ch06_ex01.so", mine / "ch06_ex01.so");
  std::ofstream(mine / "ch06_ex01.source") << source.string() << "\n" << fc_test::contents(source);
  setenv("FC_MINE", mine.c_str(), 1);
  for (const char* scene : {"billiards.yaml", "slope.yaml"}) {
    const path ours = fc_test::scratch("ours"), theirs = fc_test::scratch("theirs");
    ASSERT_EQ(ran(kScenes / scene, ours, "--clear --quiet").exit_code, 0);
    const fc_test::Outcome o = ran(kScenes / scene, theirs, "--mine");
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.out.find("yours"), std::string::npos) << o.out;
    for (const char* file : {"poses.csv", "contacts.csv", "motion.glb"})
      EXPECT_EQ(fc_test::contents(ours / file), fc_test::contents(theirs / file)) << scene << ": " << file;
  }
  unsetenv("FC_MINE");
}

}  // namespace

// The executable: exit codes, tables and their columns (contract 1.3 and 1.5).
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// The cells of a table, row by row, the header first.
std::vector<std::vector<std::string>> read_table(const fs::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(read_text(file));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream fields(line);
    for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

class Program : public testing::Test {
 protected:
  fs::path program_ = fs::path(FC_BIN_DIR) / "ch03_impulse_lcp";
  fs::path scenes_ = fs::path(FC_SOURCE_DIR) / "chapters/ch03_impulse_lcp/scenes";
  fs::path folder_ =
      fs::path(testing::TempDir()) /
      (std::string("fc_ch03_") + testing::UnitTest::GetInstance()->current_test_info()->name());

  void SetUp() override {
    if (!fs::exists(program_)) GTEST_SKIP() << "the executable is not built";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs a scene into folder_/out; standard output and error go to files there. Returns the exit code, -1 for
  // a crash.
  int run(const fs::path& scene, const std::string& options = "") {
    const std::string command =
        "'" + program_.string() + "' '" + scene.string() + "' --out '" + (folder_ / "out").string() + "' " +
        options + " > '" + (folder_ / "stdout").string() + "' 2> '" + (folder_ / "stderr").string() + "'";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int run_text(const std::string& scene) {
    std::ofstream(folder_ / "scene.yaml") << scene;
    return run(folder_ / "scene.yaml");
  }
  std::vector<std::vector<std::string>> table(const char* name) { return read_table(folder_ / "out" / name); }
  std::string errors() { return read_text(folder_ / "stderr"); }
};

using Row = std::vector<std::string>;

TEST_F(Program, WritesTheTablesOfAnLcp) {
  ASSERT_EQ(run(scenes_ / "two_contacts.yaml"), 0) << errors();
  const auto solution = table("solution.csv");
  ASSERT_EQ(solution.size(), 3u);
  EXPECT_EQ(solution[0], (Row{"row", "z", "w"}));
  EXPECT_NEAR(std::stod(solution[1][1]), 4.0 / 3, 1e-14);
  EXPECT_NEAR(std::stod(solution[2][1]), 2.0 / 3, 1e-14);
  const auto solvers = table("solvers.csv");
  ASSERT_EQ(solvers.size(), 2u);
  EXPECT_EQ(solvers[0], (Row{"solver", "status", "pivots_or_sweeps", "residual", "wall_ns"}));
  EXPECT_EQ(solvers[1][0], "dantzig");
  EXPECT_EQ(solvers[1][1], "solved");
  EXPECT_LE(std::stod(solvers[1][3]), 1e-14);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "summary.json"));
}

TEST_F(Program, WritesTheContactsOfAnImpact) {
  ASSERT_EQ(run(scenes_ / "newtons_cradle.yaml"), 0) << errors();
  const auto contacts = table("contacts.csv");
  ASSERT_EQ(contacts.size(), 3u);
  EXPECT_EQ(contacts[0], (Row{"t [s]", "body_a", "body_b", "x [m]", "y [m]", "z [m]", "nx", "ny", "nz",
                              "gap [m]", "v_before [m/s]", "v_after [m/s]", "impulse [N s]"}));
  EXPECT_NEAR(std::stod(contacts[1][12]), 4.0 / 3, 1e-14);
}

TEST_F(Program, RunsEverySceneOfTheChapter) {
  for (const fs::directory_entry& entry : fs::directory_iterator(scenes_)) {
    const bool unsolvable = entry.path().stem() == "no_solution";
    EXPECT_EQ(run(entry.path()), unsolvable ? 3 : 0) << entry.path() << errors();
    EXPECT_EQ(run(entry.path(), "--explain"), 0) << entry.path() << errors();
  }
}

TEST_F(Program, EndsWith3AndWritesTheTablesIfThereIsNoSolution) {
  EXPECT_EQ(run(scenes_ / "no_solution.yaml", "--quiet"), 3);
  EXPECT_EQ(table("solvers.csv")[1][1], "no_solution");
  EXPECT_EQ(table("solution.csv").size(), 3u);
  EXPECT_TRUE(read_text(folder_ / "stdout").empty());
  EXPECT_EQ(errors().find('\n'), errors().size() - 1);  // one line
}

TEST_F(Program, WritesTheProofThatThereIsNoSolution) {
  for (const char* method : {"dantzig", "lemke", "interior_point"}) {
    EXPECT_EQ(
        run_text("lcp: {A: [[1, -1], [-1, 1]], b: [-2, 1]}\nsolver: {method: " + std::string(method) + "}\n"),
        3);
    const auto rows = table("solution.csv");
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0], (Row{"row", "z", "w", "y"}));
    const double y0 = std::stod(rows[1][3]), y1 = std::stod(rows[2][3]);
    EXPECT_GE(std::min(y0, y1), 0) << method;
    EXPECT_LE(std::max(y0 - y1, y1 - y0), 1e-9) << method << ": A'y <= 0";
    EXPECT_LT(-2 * y0 + y1, 0) << method << ": b'y < 0";
    EXPECT_NE(errors().find("scene.yaml:1:1: there is no solution"), std::string::npos) << errors();
  }
}

TEST_F(Program, AFailureNamesTheKeyToChange) {
  const std::string lcp = "lcp: {A: [[2, -1], [-1, 2]], b: [-2, 0]}\n";
  EXPECT_EQ(run_text(lcp + "solver: {method: pgs, limit: 1}\n"), 3);
  EXPECT_NE(
      errors().find(
          "scene.yaml:2:23: solver.method pgs stopped after solver.limit = 1 sweeps with a residual of"),
      std::string::npos)
      << errors();
  EXPECT_EQ(run_text(lcp + "solver: {tolerance: 1.0e-30}\n"), 3);
  EXPECT_NE(errors().find("scene.yaml:2:10: solver.method dantzig ended with a residual of"),
            std::string::npos)
      << errors();
  EXPECT_EQ(errors().find(".cpp"), std::string::npos);
}

TEST_F(Program, EndsWith3ForAMatrixItIsNotMadeFor) {
  EXPECT_EQ(run_text("lcp: {A: [[0, 1], [1, 0]], b: [-1, -1]}\n"), 3);
  EXPECT_EQ(table("solvers.csv")[1][1], "unsuited");
}

TEST_F(Program, EndsWith2ForBadInput) {
  for (const char* scene :
       {"lcp: {A: [[1, 2]], b: [-1]}\n", "lcp: {A: [[1]], b: [-1, 2]}\n", "lcp: {A: [[.nan]], b: [-1]}\n",
        "lcp: {A: [[1]]}\n", "lcp: {matrix: none.mtx, vector: none.mtx}\n", "contacts: []\n", ""}) {
    EXPECT_EQ(run_text(scene), 2) << scene;
    EXPECT_EQ(errors().find('\n'), errors().size() - 1) << scene << errors();
  }
}

TEST_F(Program, ReadsMatrixMarketFilesAndComparesWithTheSolution) {
  std::ofstream(folder_ / "A.mtx")
      << "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 -1\n2 2 2\n";
  std::ofstream(folder_ / "b.mtx") << "%%MatrixMarket matrix array real general\n2 1\n-2\n0\n";
  std::ofstream(folder_ / "z.mtx")
      << "%%MatrixMarket matrix array real general\n2 1\n1.3333333333333333\n0.6666666666666666\n";
  const std::string lcp = "lcp: {matrix: A.mtx, vector: b.mtx, solution: z.mtx}\n";
  EXPECT_EQ(run_text(lcp), 0) << errors();
  EXPECT_NE(read_text(folder_ / "stdout").find("largest difference of w"), std::string::npos);
  std::ofstream(folder_ / "b.mtx") << "%%MatrixMarket matrix array real general\n3 1\n-2\n0\n1\n";
  EXPECT_EQ(run_text(lcp), 2);
  std::ofstream(folder_ / "b.mtx") << "%%MatrixMarket matrix array real general\n2 1\n-2\nnan\n";
  EXPECT_EQ(run_text(lcp), 2);
  EXPECT_NE(errors().find("b.mtx:4:1"), std::string::npos) << errors();
}

TEST_F(Program, SolvesByTheMethodThatTheSceneNames) {
  const std::string lcp = "lcp: {A: [[2, -1], [-1, 2]], b: [-2, 0]}\n";
  for (const char* method : {"dantzig", "lemke", "pgs", "interior_point"}) {
    ASSERT_EQ(run_text(lcp + "solver: {method: " + method + "}\n"), 0) << errors();
    const auto rows = table("solvers.csv");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1][0], method);
    EXPECT_EQ(rows[1][1], "solved");
    EXPECT_NEAR(std::stod(table("solution.csv")[1][1]), 4.0 / 3, 1e-9);
  }
  EXPECT_EQ(run_text(lcp + "solver: {method: pgs, limit: 1}\n"), 3);
  EXPECT_EQ(table("solvers.csv")[1][1], "limit");
}

TEST_F(Program, ComparesAllMethods) {
  ASSERT_EQ(run_text("lcp: {A: [[1, 1], [1, 1]], b: [-1, -1]}\nsolver: {compare: true}\n"), 0) << errors();
  const auto rows = table("solvers.csv");
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[1][0], "dantzig");  // the chosen one first
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_EQ(rows[i][1], "solved");
  // Another method's failure is an answer, not the run's.
  ASSERT_EQ(run_text("lcp: {A: [[0, 1], [-1, 0]], b: [-1, 1]}\nsolver: {method: lemke, compare: true}\n"), 0)
      << errors();
  EXPECT_EQ(table("solvers.csv")[2][1], "unsuited");
}

TEST_F(Program, WritesTheLcpOfAScene) {
  ASSERT_EQ(run(scenes_ / "box_on_floor.yaml"), 0) << errors();
  const std::string impulse = table("solution.csv")[1][1];
  fs::copy_file(folder_ / "out/A.mtx", folder_ / "A.mtx");
  fs::copy_file(folder_ / "out/b.mtx", folder_ / "b.mtx");
  ASSERT_EQ(run_text("lcp: {matrix: A.mtx, vector: b.mtx}\n"), 0) << errors();
  EXPECT_EQ(table("solution.csv")[1][1], impulse);
}

TEST_F(Program, WritesTheSameBytesAgain) {
  ASSERT_EQ(run(scenes_ / "box_on_floor.yaml"), 0);
  const std::string solution = read_text(folder_ / "out/solution.csv"),
                    contacts = read_text(folder_ / "out/contacts.csv");
  ASSERT_EQ(run(scenes_ / "box_on_floor.yaml"), 0);
  EXPECT_EQ(read_text(folder_ / "out/solution.csv"), solution);
  EXPECT_EQ(read_text(folder_ / "out/contacts.csv"), contacts);
}

// Velocities, not impulses: these need not be unique.
TEST_F(Program, ClearFindsTheSameVelocities) {
  for (const char* scene : {"three_balls", "newtons_cradle", "box_on_floor"}) {
    ASSERT_EQ(run(scenes_ / (std::string(scene) + ".yaml")), 0) << errors();
    const auto fast = table("contacts.csv");
    ASSERT_EQ(run(scenes_ / (std::string(scene) + ".yaml"), "--clear"), 0) << errors();
    const auto clear = table("contacts.csv");
    ASSERT_EQ(clear.size(), fast.size()) << scene;
    for (std::size_t i = 1; i < clear.size(); ++i)
      EXPECT_NEAR(std::stod(clear[i][11]), std::stod(fast[i][11]), 1e-14)
          << scene << ", contact " << i << ", m/s";
  }
  EXPECT_EQ(run(scenes_ / "no_solution.yaml", "--clear"), 3);
  EXPECT_EQ(table("solution.csv")[0], (Row{"row", "z", "w", "y"}));
}

TEST_F(Program, MineWritesTheBytesOfClear) {
  const fs::path module = fs::path(FC_BIN_DIR).parent_path() / "pieces/book/ch03_ex06.so";
  const fs::path source = fs::path(FC_SOURCE_DIR) / "solutions/ch03/ex06_dantzig.cpp";
  if (!fs::exists(module)) GTEST_SKIP() << "the piece is not built";
  fs::create_directories(folder_ / "mine");
  fs::copy_file(module, folder_ / "mine/ch03_ex06.so");
  std::ofstream(folder_ / "mine/ch03_ex06.source") << source.string() << "\n" << read_text(source);
  setenv("FC_MINE", (folder_ / "mine").c_str(), 1);
  for (const char* scene : {"three_balls.yaml", "box_on_floor.yaml", "redundant.yaml"}) {
    ASSERT_EQ(run(scenes_ / scene, "--clear"), 0) << errors();
    const std::string clear = read_text(folder_ / "out/solution.csv");
    ASSERT_EQ(run(scenes_ / scene, "--mine"), 0) << errors();
    EXPECT_EQ(errors(), "");
    EXPECT_EQ(read_text(folder_ / "out/solution.csv"), clear) << scene;
    EXPECT_NE(read_text(folder_ / "stdout").find("yours"), std::string::npos);
  }
  unsetenv("FC_MINE");
}

TEST_F(Program, LeavesBodiesThatDoNotApproachAlone) {
  ASSERT_EQ(run(scenes_ / "newtons_cradle.yaml", "--set bodies.0.velocity=[-1,0,0]"), 0) << errors();
  EXPECT_EQ(table("contacts.csv").size(), 1u);
  EXPECT_EQ(table("solution.csv")[1][1], "0");
}

}  // namespace

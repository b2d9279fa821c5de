// What stands in a run's folder after runs that end well, are refused, fail, or are killed.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <map>

#include "scene_files.hpp"

namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Results : public testing::Test {
 protected:
  void SetUp() override {
    here_ = fc_test::folder() /
            (std::string("results_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(here_);
    fs::create_directories(here_);
    std::ofstream(here_ / "ball.yaml") << fc_test::one_ball;
  }

  // Runs a line of the shell in this test's folder, "tiny" being the program.
  int shell(const std::string& line) const {
    const int status =
        std::system(("cd '" + here_.string() + "'; tiny() { '" FC_TINY_CHAPTER "' --quiet ball.yaml $*; }; " +
                     line + " 2>err.txt")
                        .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string errors() const { return contents(here_ / "err.txt"); }

  // Every file below a folder, hidden ones included, with what is in it.
  std::map<std::string, std::string> files(const std::string& folder) const {
    std::map<std::string, std::string> all;
    if (!fs::exists(here_ / folder)) return all;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(here_ / folder))
      all[fs::relative(entry.path(), here_ / folder).string()] =
          entry.is_directory() ? "folder" : contents(entry.path());
    return all;
  }
  std::vector<std::string> names(const std::string& folder) const {
    std::vector<std::string> all;
    for (const auto& [name, text] : files(folder)) all.push_back(name);
    return all;
  }

  fs::path here_;
};
using Names = std::vector<std::string>;

TEST_F(Results, OfARefusedRunAreNone) {
  EXPECT_EQ(shell("tiny --out new/deep --set name=bad-input"), 2);
  EXPECT_EQ(shell("tiny --set name=bad-input"), 2);
  EXPECT_EQ(shell("tiny --out new --set name=late --sweep step.dt=0.01,0.1"), 2);
  EXPECT_EQ(names("."), (Names{"ball.yaml", "err.txt"}));
}

TEST_F(Results, OfTheRunBeforeOutliveARefusedOne) {
  ASSERT_EQ(shell("tiny --out out --poses"), 0);
  const auto before = files("out");
  EXPECT_EQ(names("out"), (Names{"poses.csv", "steps.csv", "summary.json"}));
  for (const char* refused : {"--set name=bad-input", "--set step.dt=-1", "--set nonsense=1", "--nonsense",
                              "--set name=late --sweep step.dt=0.01,0.1"}) {
    EXPECT_EQ(shell("tiny --out out " + std::string(refused)), 2) << refused;
    EXPECT_EQ(files("out"), before) << refused;
  }
}

TEST_F(Results, OfAFailedRunAreWhatThereIs) {
  ASSERT_EQ(shell("tiny --out out --poses"), 0);
  EXPECT_EQ(shell("tiny --out out --set name=numerical"), 3);
  EXPECT_EQ(names("out"), (Names{"steps.csv", "summary.json"}));
  EXPECT_EQ(contents(here_ / "out/steps.csv"), "step,t [s]\n0,0\n");
  EXPECT_NE(contents(here_ / "out/summary.json").find("energy grew"), std::string::npos);
}

// What an earlier run left must not be taken for this one's; files that belong to no run stay.
TEST_F(Results, OfTheRunBeforeGoWhereThisOneHasNone) {
  ASSERT_EQ(shell("tiny --out out --sweep step.dt=0.1,0.5 --poses"), 0);
  EXPECT_EQ(names("out"),
            (Names{"step.dt=0.1", "step.dt=0.1/poses.csv", "step.dt=0.1/steps.csv",
                   "step.dt=0.1/summary.json", "step.dt=0.5", "step.dt=0.5/poses.csv",
                   "step.dt=0.5/steps.csv", "step.dt=0.5/summary.json", "summary.json", "sweep.csv"}));
  std::ofstream(here_ / "out/step.dt=0.5/notes.txt") << "mine";
  std::ofstream(here_ / "out/poses.csv") << "mine";
  ASSERT_EQ(shell("tiny --out out"), 0);
  EXPECT_EQ(names("out"),
            (Names{"poses.csv", "step.dt=0.5", "step.dt=0.5/notes.txt", "steps.csv", "summary.json"}));
  ASSERT_EQ(shell("tiny --out out --sweep step.dt=0.1,0.25"), 0);
  EXPECT_EQ(contents(here_ / "out/poses.csv"), "mine");
  EXPECT_FALSE(fs::exists(here_ / "out/steps.csv"));
}

TEST_F(Results, ListedByTheSummaryAreNeverOutsideOfTheFolder) {
  fs::create_directories(here_ / "out");
  std::ofstream(here_ / "out/summary.json")
      << R"({"files": ["../ball.yaml", "/etc/none", 3, "kept", "gone.csv"]})";
  std::ofstream(here_ / "out/gone.csv") << "of the run before";
  fs::create_directories(here_ / "out/kept");
  ASSERT_EQ(shell("tiny --out out"), 0);
  EXPECT_EQ(names("."),
            (Names{"ball.yaml", "err.txt", "out", "out/kept", "out/steps.csv", "out/summary.json"}));
}

TEST_F(Results, ThatCannotBePutInPlaceAreKept) {
  fs::create_directories(here_ / "out/steps.csv");
  EXPECT_EQ(shell("tiny --out out"), 2);
  EXPECT_TRUE(errors().starts_with("out/steps.csv: is a folder; the results are in out/.unfinished-"))
      << errors();
  EXPECT_FALSE(fs::exists(here_ / "out/summary.json"));
}

// Killed while it writes: the run before is whole, and nothing lies about.
TEST_F(Results, OfTheRunBeforeOutliveAKilledOne) {
  ASSERT_EQ(shell("tiny --out out --poses"), 0);
  const auto before = files("out");
  for (const char* signal : {"TERM", "HUP", "INT"}) {
    // Not in the background, where the shell would have it ignore INT; it is killed once it has written.
    const std::string killer =
        "(until grep -q 1 out/.unfinished-*/steps.csv 2>/dev/null; do sleep 0.05; done; kill -" +
        std::string(signal) + " $(cat pid)) & sh -c 'echo $$ >pid; exec $0 $*' ";
    const int code = shell(killer + "'" FC_TINY_CHAPTER "' --quiet ball.yaml --set name=hangs --out out");
    EXPECT_EQ(code, 128 + (signal[0] == 'T' ? 15 : signal[0] == 'H' ? 1 : 2)) << signal;
    EXPECT_EQ(files("out"), before) << signal;
  }
}

TEST_F(Results, ASignalThatTheCallerIgnoresIsIgnored) {
  const int code = shell(
      "trap '' TERM; (until grep -q 1 out/.unfinished-*/steps.csv 2>/dev/null; do sleep 0.05; done; "
      "kill -TERM $(cat pid); sleep 0.2; kill -0 $(cat pid) && echo lives >state; kill -HUP $(cat pid)) & "
      "sh -c 'echo $$ >pid; exec $0 $*' '" FC_TINY_CHAPTER "' --quiet ball.yaml --set name=hangs --out out");
  EXPECT_EQ(code, 129);
  EXPECT_EQ(contents(here_ / "state"), "lives\n");
}

}  // namespace

// The tiny chapter's executable, from outside: options, exit codes, what is written where.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "scene_files.hpp"

namespace {

struct Result {
  int exit_code;
  std::string out, err;
};

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Runs the tiny chapter in a folder of this test's own.
class Program : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    here_ = fc_test::folder() / test->name();
    std::filesystem::remove_all(here_);
    std::filesystem::create_directories(here_);
    std::ofstream(here_ / "ball.yaml") << fc_test::one_ball;
  }

  Result run(const std::string& arguments) const {
    const std::string command =
        "cd '" + here_.string() + "' && '" FC_TINY_CHAPTER "' " + arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(here_ / "stdout.txt"),
            contents(here_ / "stderr.txt")};
  }

  nlohmann::json summary(const std::string& folder) const {
    return nlohmann::json::parse(contents(here_ / folder / "summary.json"));
  }

  static bool is_one_line(const std::string& text) {
    return !text.empty() && text.find('\n') == text.size() - 1;
  }

  std::filesystem::path here_;
};

TEST_F(Program, RunsIntoTheDefaultFolder) {
  const Result result = run("ball.yaml");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out,
            "ball: results in out/ball\n"
            "  frames    100\n"
            "  duration  1 s\n"
            "  method    dantzig\n");
  EXPECT_EQ(contents(here_ / "out/ball/steps.csv"), "step,t [s]\n0,0\n");
  const auto json = summary("out/ball");
  EXPECT_EQ(json["exit_code"], 0);
  EXPECT_EQ(json["entries"]["duration"]["value"], 1.0);
  EXPECT_EQ(json["entries"]["duration"]["unit"], "s");
  EXPECT_EQ(json["counters"]["lcp"]["runs"], 12);
  EXPECT_EQ(json["counters"]["lcp"]["ns"], 3400);
}

TEST_F(Program, TheDefaultFolderStaysBelowOut) {
  EXPECT_EQ(run("ball.yaml --set name=../../up --quiet").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(here_ / "out/_._.._up/summary.json"));
}

TEST_F(Program, QuietPrintsNothing) {
  const Result result = run("--quiet ball.yaml --out here");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_TRUE(std::filesystem::exists(here_ / "here/summary.json"));
}

TEST_F(Program, OptionsDoNotSwallowTheScene) {
  EXPECT_EQ(run("--set step.dt=0.5 --set step.duration=2 ball.yaml --out a").exit_code, 0);
  EXPECT_EQ(summary("a")["entries"]["frames"]["value"], 4);
  EXPECT_EQ(run("--mesh-path . ball.yaml --out b --poses").exit_code, 0);
}

TEST_F(Program, BadOptionsAreOneLineAndExitCode2) {
  for (const char* arguments :
       {"", "--nonsense ball.yaml", "ball.yaml ball.yaml", "ball.yaml --out", "ball.yaml --set",
        "ball.yaml --out ''", "ball.yaml --set gravity", "ball.yaml --sweep step.dt",
        "ball.yaml --sweep step.dt=", "ball.yaml --sweep =1", "ball.yaml --mesh-path nowhere",
        "ball.yaml --sweep step.dt=1 --sweep step.dt=2", "ball.yaml --quiet=3"}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(is_one_line(result.err)) << arguments << ": " << result.err;
    EXPECT_EQ(result.out, "") << arguments;
  }
}

TEST_F(Program, BadInputIsOneLineAndExitCode2) {
  Result result = run("nowhere.yaml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "nowhere.yaml: no such file; check the path\n");
  result = run("ball.yaml --set 'step.dt=a\nb'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  result = run("ball.yaml --set name=bad-input");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "ball.yaml:5:5: the ball overlaps; move it\n");
}

TEST_F(Program, AFolderThatCannotBeWrittenIsExitCode2) {
  const Result result = run("ball.yaml --out ball.yaml/inside");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(result.err.starts_with("--out ball.yaml/inside: ")) << result.err;
  EXPECT_TRUE(is_one_line(result.err));
  EXPECT_EQ(run("ball.yaml --out ball.yaml").exit_code, 2);
  EXPECT_EQ(run("ball.yaml --out /proc/no").exit_code, 2);
  EXPECT_EQ(run("ball.yaml --out " + std::string(5000, 'x')).exit_code, 2);
}

TEST_F(Program, FailuresAreExitCode3WithTheSummaryWritten) {
  const std::pair<const char*, const char*> failures[] = {{"numerical", "energy grew\\x0aby 3 J at step 7\n"},
                                                          {"mistake", "radius is -1, expected > 0\n"},
                                                          {"reported", ""}};
  for (const auto& [name, message] : failures) {
    const Result result = run("ball.yaml --set name=" + std::string(name));
    EXPECT_EQ(result.exit_code, 3) << name;
    EXPECT_EQ(result.err, message);
    const auto json = summary("out/" + std::string(name));
    EXPECT_EQ(json["exit_code"], 3) << name;
    EXPECT_EQ(json.contains("failure"), *message != 0) << name;
    EXPECT_EQ(json["entries"]["frames"]["value"], 100) << name;
    EXPECT_TRUE(std::filesystem::exists(here_ / "out" / name / "steps.csv")) << name;
  }
}

TEST_F(Program, AFailureBeginsWithTheKeyThatItIsAbout) {
  std::ofstream(here_ / "solver.yaml") << fc_test::one_ball << "solver:\n  limit: 5\n";
  const std::string rest = "the limit was reached; raise it\n";
  EXPECT_EQ(run("solver.yaml --set name=keyed").err, "solver.yaml:7:3: " + rest);
  EXPECT_EQ(run("ball.yaml --set name=keyed --set solver.limit=7").err, "--set solver.limit=7: " + rest);
  EXPECT_EQ(run("ball.yaml --set name=keyed --set solver.method=pgs").err,
            "--set solver.method=pgs: " + rest);
  EXPECT_EQ(run("ball.yaml --set name=keyed").err, "ball.yaml: " + rest);
  const Result memory = run("ball.yaml --set name=memory");
  EXPECT_EQ(memory.exit_code, 3);
  EXPECT_EQ(memory.err, "ball.yaml: the scene needs more memory than there is; make it smaller\n");
}

TEST_F(Program, NanAndInfinityAreNeverNull) {
  EXPECT_EQ(run("ball.yaml --set name=nan").exit_code, 0);
  EXPECT_EQ(summary("out/nan")["entries"]["drift"]["value"], "nan");
  EXPECT_EQ(summary("out/nan")["entries"]["gap"]["value"], "inf");
}

TEST_F(Program, SweepsWriteOneRowPerValue) {
  const Result result = run("ball.yaml --sweep step.dt=0.1,0.5 --out s");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(contents(here_ / "s/sweep.csv"),
            "step.dt [s],frames,duration [s],method,lcp_runs,lcp_ns,exit_code\n"
            "0.1,10,1,dantzig,12,3400,0\n"
            "0.5,2,1,dantzig,12,3400,0\n");
  EXPECT_TRUE(std::filesystem::exists(here_ / "s/step.dt=0.1/summary.json"));
}

TEST_F(Program, SweepsCheckEveryValueFirst) {
  const Result result = run("ball.yaml --sweep step.dt=0.1,-1 --out s");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "--sweep step.dt=-1: 'dt' is -1, out of range [1e-09, 1000]; write e.g. dt: 0.01\n");
  EXPECT_FALSE(std::filesystem::exists(here_ / "s"));
}

TEST_F(Program, AFailedRunOfASweepKeepsTheOthers) {
  const Result result = run("ball.yaml --set name=slow --sweep step.dt=0.1,0.01 --out s --quiet");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err, "dt is too long\n");
  EXPECT_EQ(contents(here_ / "s/sweep.csv"),
            "step.dt [s],frames,duration [s],method,lcp_runs,lcp_ns,exit_code\n"
            "0.1,10,1,dantzig,12,3400,3\n"
            "0.01,100,1,dantzig,12,3400,0\n");
}

TEST_F(Program, ASweepMaySupplyWhatTheSceneLacks) {
  std::ofstream(here_ / "half.yaml") << "step: {duration: 1}\n" +
                                            fc_test::one_ball.substr(fc_test::one_ball.find('\n') + 1);
  EXPECT_EQ(run("half.yaml --sweep step.dt=0.1,0.5").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(here_ / "out/half/sweep.csv"));
}

TEST_F(Program, ExplainPrintsEffectsAndRunsNothing) {
  const Result result = run("ball.yaml --explain --set gravity=[0,0,-1]");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("gravity  declared at line 0  acceleration  0"), std::string::npos) << result.out;
  EXPECT_NE(run("ball.yaml --explain").out.find("no effect is on"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(here_ / "out"));
}

TEST_F(Program, HelpShowsPurposeOptionsExampleAndKeys) {
  const Result result = run("--help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* text : {"Tries what chapters share.", "--out", "--set", "--sweep", "--explain",
                           "--mesh-path", "--certificate", "--poses", "--clear", "--mine", "--quiet",
                           "--help", "ch04_tiny scene.yaml", "gravity", "bodies[].grid.spacing"}) {
    EXPECT_NE(result.out.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(result.out.find("interval"), std::string::npos);  // chapters 1 and 2 only
}

// A folder as exercises/check.py fills it, for the tiny chapter's pieces.
class Pieces : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::filesystem::create_directories(mine());
    std::ofstream(here_ / "twice.cpp") << kSource;
  }
  std::filesystem::path mine() const { return here_ / "mine"; }
  void hand_over(const char* module, const std::string& name) const {
    std::filesystem::copy_file(module, mine() / (name + ".so"));
    std::ofstream(mine() / (name + ".source")) << (here_ / "twice.cpp").string() << "\n" << kSource;
  }
  Result run_mine(const std::string& options) const {
    setenv("FC_MINE", mine().c_str(), 1);
    const Result result = run("ball.yaml " + options);
    unsetenv("FC_MINE");
    return result;
  }
  nlohmann::json entry(const std::string& name) const {
    return summary("out/ball")["entries"][name]["value"];
  }
  static constexpr const char* kSource = "double twice(double x) {\n  return 3 * x;\n}\n";
};

TEST_F(Pieces, ClearRunsOnTheBooks) {
  hand_over(FC_GOOD_PIECE, "ch04_ex01");
  const Result result = run_mine("--clear");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(entry("twice three"), 6);
  EXPECT_EQ(entry("piece 4.1, twice a number"), "the book's");
}

TEST_F(Pieces, MineRunsOnTheLearnersAndSaysWhichAreWhose) {
  hand_over(FC_GOOD_PIECE, "ch04_ex01");
  const Result result = run_mine("--mine");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(entry("twice three"), 9);
  EXPECT_EQ(entry("piece 4.1, twice a number"), "yours");
  EXPECT_EQ(entry("piece 4.2, half a number"), "the book's");
}

TEST_F(Pieces, WhatDoesNotPassIsRefusedInALine) {
  hand_over(FC_GOOD_PIECE, "ch04_ex01");
  std::ofstream(mine() / "ch04_ex02.refused") << "3/8 tests pass\n";
  const Result result = run_mine("--mine --quiet");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(
      result.err,
      "--mine: the book's version stands in for your 4.2 (half a number): 3/8 tests pass; ./run check ch04/ex02\n");
}

TEST_F(Pieces, WhatHasChangedSinceItWasCheckedIsRefused) {
  hand_over(FC_GOOD_PIECE, "ch04_ex01");
  hand_over(FC_OTHER_PIECE, "ch04_ex02");  // of another type
  std::string err = run_mine("--mine").err;
  EXPECT_NE(err.find("4.2 (half a number): it was compiled for another version"), std::string::npos) << err;
  EXPECT_EQ(entry("twice three"), 9);
  std::filesystem::remove(mine() / "ch04_ex02.so");
  std::ofstream(here_ / "twice.cpp", std::ios::app) << "// better\n";
  const Result result = run_mine("--mine");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(
      result.err,
      "--mine: the book's version stands in for your 4.1 (twice a number): its file has changed since it was checked; "
      "./run check ch04/ex01\n"
      "--mine: of the 2 pieces that this program runs on, none of yours passes its tests yet; write 4.1 "
      "(exercises/ch04/README.md), then ./run check\n");
}

TEST_F(Pieces, NoneOfTheLearnersIsRefused) {
  const Result result = run_mine("--mine");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_FALSE(std::filesystem::exists(here_ / "out"));
  EXPECT_EQ(run_mine("--mine --clear").exit_code, 2);
}

TEST_F(Pieces, AProgramWithoutPiecesHasNeither) {
  setenv("FC_NO_PIECES", "1", 1);
  for (const char* option : {"clear", "mine"}) {
    const Result result = run_mine(std::string("--") + option);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, std::string("--") + option + ": this program has no clear version; leave it out\n");
  }
  unsetenv("FC_NO_PIECES");
}

}  // namespace

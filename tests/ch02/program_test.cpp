// The executables of chapters 1 and 2 from outside: their tables as contract 1.5 has them, motions files,
// exit codes.
#include <cmath>
#include <fstream>

#include "tests/support/run_files.hpp"

namespace {

using namespace fc_test;

const std::string header = [] {
  std::string text;
  for (const std::string body : {"a_", "b_"})
    for (const std::string name :
         {"px", "py", "pz", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"})
      text += (text.empty() ? "" : ",") + body + name;
  return text;
}();
const std::string rest = "0,0,0,1,0,0,0,0,0,0,0,0,0";
// Unit cubes, of which B comes along x from 3: contact at half the interval, never, at the start, inside.
const std::string rows = rest + ",3,0,0,1,0,0,0,-4,0,0,0,0,0\n" +         //
                         rest + ",3,0,0,2,0,0,0,4,0,0,0,0,0\n" +          //
                         rest + ",1,0,0,1,0,0,0,-4,0,0,1,2,3\n" +         //
                         rest + ", 0.5 ,0,0,1,0,0,0,1e0,0,0,0,0,0\r\n" +  //
                         rest + ",3,0.1,0.2,1,2,3,4,-4,0,0,1,2,3\n";
const std::string scene =
    "name: two\nshapes:\n  cube: {box: {size: [1, 1, 1]}}\nbodies:\n"
    "  - {shape: cube}\n  - {shape: cube, position: [3, 0, 0], velocity: [-4, 0, 0]}\n";

class QueryProgram : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    here_ = scratch(std::string("query_") + GetParam());
    write("scene.yaml", scene);
    write("motions.csv", header + "\n" + rows);
    write("many.yaml", scene + "motions: motions.csv\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(here_ / name, std::ios::binary) << text;
  }
  Outcome ask(const std::string& arguments) const {
    return run("cd '" + here_.string() + "' && '" FC_BIN_DIR "/" + GetParam() + "' " + arguments);
  }
  Table table(const std::string& name) const { return read_table(here_ / name); }
  void expect_refused(const std::string& arguments, const std::string& start) const {
    const Outcome o = ask(arguments);
    EXPECT_EQ(o.exit_code, 2) << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_TRUE(o.err.starts_with(start)) << o.err;
    EXPECT_EQ(o.err.find('\n'), o.err.size() - 1) << o.err;
  }
  std::filesystem::path here_;
};

TEST_P(QueryProgram, TablesHaveTheColumnsOfTheContract) {
  const Outcome o = ask("many.yaml --out a --certificate");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const Table q = table("a/queries.csv"), f = table("a/features.csv"), c = table("a/certificate.csv");
  EXPECT_EQ(q.header(),
            "query,status,toc [1],gap_lower [m],gap_upper "
            "[m],iterations,distance_calls,node_pairs,features,wall_ns");
  EXPECT_EQ(f.header(),
            "query,ax [m],ay [m],az [m],bx [m],by [m],bz [m],nx,ny,nz,gap [m],kind_a,kind_b,id_a,id_b");
  EXPECT_EQ(c.header(), "query,k,t [s],nx,ny,nz,gap_lower [m],speed_bound [m/s],advance [s]");
  for (const Table* t : {&q, &f, &c}) EXPECT_TRUE(is_full(*t));
  ASSERT_EQ(q.rows(), 5);
  const char* status[] = {"contact", "separated", "touching_at_start", "penetrating_at_start", "contact"};
  int features = 0;
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(q.cells[i][0], std::to_string(i));
    EXPECT_EQ(q.cells[i][1], status[i]) << i;
    EXPECT_TRUE(std::isfinite(q.at(i, "gap_lower"))) << i;
    features += static_cast<int>(q.at(i, "features"));
  }
  EXPECT_LE(q.at(0, "toc"), 0.5);
  EXPECT_GE(q.at(0, "toc"), 0.5 - 1e-6);
  EXPECT_LE(q.at(0, "gap_upper"), 1e-6);
  EXPECT_EQ(q.cells[1][2], "1");
  EXPECT_EQ(q.cells[2][2], "0");
  EXPECT_EQ(q.cells[3][2], "0");
  ASSERT_EQ(f.rows(), features);
  for (int i = 0; i < f.rows(); ++i) {
    const double n[] = {f.at(i, "nx"), f.at(i, "ny"), f.at(i, "nz")};
    EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-14);
    const double along = n[0] * (f.at(i, "bx") - f.at(i, "ax")) + n[1] * (f.at(i, "by") - f.at(i, "ay")) +
                         n[2] * (f.at(i, "bz") - f.at(i, "az"));
    EXPECT_NEAR(along, f.at(i, "gap"), 1e-12);
    if (f.cells[i][0] == "0") {
      EXPECT_NEAR(n[0], 1, 1e-9);  // from A to B
    }
  }
  ASSERT_GE(c.rows(), 3);
  for (int i = 0; i < c.rows(); ++i) {
    EXPECT_GE(c.at(i, "gap_lower"), c.at(i, "speed_bound") * c.at(i, "advance"));
    EXPECT_GE(c.at(i, "advance"), 0);
  }
  EXPECT_FALSE(std::filesystem::exists(here_ / "b/certificate.csv"));
  EXPECT_NE(contents(here_ / "a/summary.json").find("\"exit_code\": 0"), std::string::npos);
}

TEST_P(QueryProgram, TheSameBytesAgain) {
  for (const std::string out : {"a", "b"})
    ASSERT_EQ(ask("many.yaml --quiet --certificate --set interval=1.7 --out " + out).exit_code, 0);
  EXPECT_EQ(without_times(table("a/queries.csv")), without_times(table("b/queries.csv")));
  for (const std::string file : {"features.csv", "certificate.csv"})
    EXPECT_EQ(contents(here_ / "a" / file), contents(here_ / "b" / file)) << file;
}

TEST_P(QueryProgram, TheIntervalAndTheBodiesOwnMotions) {
  ASSERT_EQ(ask("scene.yaml --quiet --out a").exit_code, 0);
  ASSERT_EQ(ask("scene.yaml --quiet --out b --set interval=4").exit_code, 0);
  ASSERT_EQ(ask("scene.yaml --quiet --out c --set interval=0.25").exit_code, 0);
  EXPECT_NEAR(table("a/queries.csv").at(0, "toc"), 0.5, 1e-6);  // a fraction of the interval
  EXPECT_NEAR(table("b/queries.csv").at(0, "toc"), 0.125, 1e-6);
  EXPECT_EQ(table("c/queries.csv").cells[0][1], "separated");
  EXPECT_EQ(table("c/queries.csv").cells[0][2], "1");
}

TEST_P(QueryProgram, TheSummaryHasTheTimeAsAFractionAndInSeconds) {
  ASSERT_EQ(ask("scene.yaml --quiet --out a --sweep interval=4,0.25").exit_code, 0);
  const Table sweep = table("a/sweep.csv");
  EXPECT_NEAR(sweep.at(0, "time of contact"), 0.125, 1e-6);
  EXPECT_NEAR(sweep.at(0, "first contact at"), 0.5, 1e-6);
  EXPECT_EQ(sweep.at(1, "clear until"), 1);  // separated: a time of contact would be a lie
  EXPECT_EQ(sweep.at(1, "clear for"), 0.25);
}

TEST_P(QueryProgram, ALimitIsAnAnswer) {
  const Outcome o = ask("many.yaml --out a --set ccd.max_iterations=1");
  EXPECT_EQ(o.exit_code, 0) << o.err;
  const Table q = table("a/queries.csv");
  EXPECT_EQ(q.cells[4][1], "unresolved");
  EXPECT_LT(q.at(4, "toc"), 0.6);
}

TEST_P(QueryProgram, BadMotionsAreRefusedByLine) {
  const auto refused = [&](const std::string& text, const std::string& where) {
    write("motions.csv", text);
    expect_refused("many.yaml --out x", where);
  };
  const std::string good = rest + "," + rest + "\n";
  refused("", "motions.csv:1:1: ");
  refused(good, "motions.csv:1:1: ");
  refused("x" + header + "\n" + good, "motions.csv:1:1: ");
  refused(header + "\n", "motions.csv");
  refused(header + "\n" + good + rest + "\n", "motions.csv:3:");
  refused(header + "\n" + rest + "," + rest + ",1\n", "motions.csv:2:");
  refused(header + "\nnan" + good.substr(1), "motions.csv:2:1: ");
  refused(header + "\n0,inf" + good.substr(3), "motions.csv:2:3: ");
  refused(header + "\n0,1e999" + good.substr(3), "motions.csv:2:3: ");
  refused(header + "\n0,," + good.substr(4), "motions.csv:2:3: ");
  refused(header + "\n0,1m" + good.substr(3), "motions.csv:2:3: ");
  refused(header + "\n0,0,0,0" + good.substr(7), "motions.csv:2:");     // a zero quaternion
  refused(header + "\n0,1e300" + good.substr(3), "motions.csv:2:3: ");  // its square is no number
  std::filesystem::remove(here_ / "motions.csv");
  expect_refused("many.yaml --out x", "many.yaml:");
  EXPECT_FALSE(std::filesystem::exists(here_ / "x/queries.csv"));
}

TEST_P(QueryProgram, BadScenesAndOptions) {
  expect_refused("scene.yaml --set interval=-1", "");
  expect_refused("scene.yaml --set ccd.bound=fastest", "");
  expect_refused("scene.yaml --set gravity=[0,0,-1]", "");
  expect_refused("nowhere.yaml", "nowhere.yaml: ");
  expect_refused("scene.yaml --nonsense", "");
  EXPECT_EQ(ask("scene.yaml --explain").exit_code, 0);
  EXPECT_EQ(ask("--help").exit_code, 0);
}

INSTANTIATE_TEST_SUITE_P(Chapters, QueryProgram,
                         testing::Values("ch01_convex_advancement", "ch02_hull_hierarchy"),
                         [](const auto& chapter) { return std::string(chapter.param).substr(0, 4); });

}  // namespace

// ch02_replay from outside: what chapter 2's executable wrote is proved, and what was changed in it is
// refused, with its line.
#include <algorithm>
#include <functional>
#include <random>

#include "tests/support/changed_tables.hpp"

namespace {

using namespace fc_test;
using std::filesystem::path;

const std::string kBin = FC_BIN_DIR;
const path kScenes = path(FC_SOURCE_DIR) / "chapters/ch02_hull_hierarchy/scenes";

std::string quoted(const path& file) {
  return "'" + file.string() + "'";
}

// Runs chapter 2 with a certificate; the folder.
path answered(const path& scene, const std::string& name, const std::string& options = "") {
  const path folder = scratch(name);
  const Outcome o = run(kBin + "/ch02_hull_hierarchy " + quoted(scene) + " --certificate --quiet " + options +
                        " --out " + quoted(folder));
  EXPECT_EQ(o.exit_code, 0) << o.err;
  return folder;
}

Outcome replayed(const path& scene, const path& folder, const std::string& options = "") {
  return run(kBin + "/ch02_replay " + quoted(scene) + " " + quoted(folder) + " " + options);
}

void expect_proved(const path& scene, const path& folder, const std::string& options = "") {
  const Outcome o = replayed(scene, folder, options);
  EXPECT_EQ(o.exit_code, 0) << o.out << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_NE(o.out.find(", 0 refused"), std::string::npos) << o.out;
}

// 40 flights of two bodies, turning, at each other and past; some overlap at the start.
path random_scene(const std::string& name, const std::string& shape_a, const std::string& shape_b) {
  const path folder = scratch("scene_" + name);
  for (const char* mesh : {"ring.obj", "nut.obj"})
    std::filesystem::copy_file(kScenes / mesh, folder / mesh,
                               std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder / "scene.yaml")
      << "name: " << name << "\ninterval: 1.3\nmotions: motions.csv\nshapes:\n  a: " << shape_a
      << "\n  b: " << shape_b << "\nbodies:\n  - {shape: a}\n  - {shape: b}\n";
  std::mt19937_64 random(7);
  const auto any = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
  std::ofstream motions(folder / "motions.csv");
  for (const char* body : {"a_", "b_"})
    for (const char* column : {"px", "py", "pz", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"})
      motions << (body[0] == 'a' && column == std::string("px") ? "" : ",") << body << column;
  motions << '\n';
  motions.precision(17);
  for (int row = 0; row < 40; ++row) {
    const double fast = row % 3 == 0 ? 20 : row % 3 == 1 ? 3 : 0, apart = row % 8 == 7 ? 0.4 : 2;
    for (const double x : {-apart, apart}) {
      motions << (x < 0 ? "" : ",") << x << ',' << any(0.7) << ',' << any(0.7);
      for (int i = 0; i < 4; ++i) motions << ',' << any(1);
      motions << ',' << (row % 5 == 4 ? 1 : -1.5) * x + any(1) << ',' << any(0.5) << ',' << any(0.5);
      for (int i = 0; i < 3; ++i) motions << ',' << any(fast);
    }
    motions << '\n';
  }
  return folder / "scene.yaml";
}

TEST(HierarchyReplayProgram, ProvesMeshesAndConvexShapes) {
  const std::string hull = "{hull: {points: [[0,0,0],[1,0,0.1],[0,0.8,0],[0.2,0.1,0.9],[0.7,0.6,0.5]]}}";
  const std::vector<std::string> kinds = {"{mesh: ring.obj}", "{sphere: {radius: 0.4}}",
                                          "{capsule: {radius: 0.2, length: 0.9}}",
                                          "{box: {size: [0.9, 0.6, 0.2]}}", hull};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const path scene = random_scene("kind" + std::to_string(i), kinds[0], kinds[i]);
    const path folder = answered(scene, "kind");
    expect_proved(scene, folder);
    const std::string answers = contents(folder / "queries.csv");
    for (const char* status : {"contact", "separated"})
      EXPECT_NE(answers.find(status), std::string::npos) << kinds[i];
  }
}

TEST(HierarchyReplayProgram, ProvesEveryStatus) {
  const path scene = kScenes / "interlocked_rings.yaml";
  for (const char* options :
       {"", "--set ccd.tolerance=1e-12", "--set ccd.tolerance=0.01", "--set ccd.max_iterations=50",
        "--set interval=0.1", "--set interval=0.7", "--set bodies.1.velocity=[0,0,0]",
        "--set bodies.1.position=[0.6,0,0]", "--set bodies.1.position=[9,0,0]"})
    expect_proved(scene, answered(scene, "status", options), options);
}

TEST(HierarchyReplayProgram, ProvesTheBunnies) {
  if (!std::filesystem::exists("/usr/share/glmark2/models/bunny.obj"))
    GTEST_SKIP() << "the bunny is not there";
  const path scene = kScenes / "two_bunnies.yaml";
  expect_proved(scene, answered(scene, "bunnies"));
}

// The tables of a run, by their lines; the header is line 0.
struct Tables {
  Lines queries, certificate, leaves;
};

enum Column { kQuery, kK, kT, kNx, kNy, kNz, kGap, kSpeed, kAdvance };

struct Change {
  std::string name;
  std::function<void(Tables&)> make;
  std::string expected;
};

const int kRow = 6;  // the line that most changes are about, from 0

void raise(std::string& line, int column, double by) {
  line = with(line, column, cell(line, column) + by);
}

// The contents of a row and its block go, and later ones move up: the numbers stay in order.
void drop(Tables& t, std::size_t row) {
  for (std::size_t k = row; k + 1 < t.certificate.size(); ++k) {
    t.certificate[k] = with(t.certificate[k + 1], kK, static_cast<double>(k) - 1);
    t.leaves[k] = with(t.leaves[k + 1], kK, static_cast<double>(k) - 1);
  }
  t.certificate.pop_back();
  t.leaves.pop_back();
}

const std::vector<Change>& changes() {
  static const std::vector<Change> all = {
      {"DroppedRow", [](Tables& t) { t.certificate.erase(t.certificate.begin() + kRow); },
       "certificate.csv:7: row 6 of query 0 is out of order"},
      {"DroppedLeaves", [](Tables& t) { t.leaves.erase(t.leaves.begin() + kRow); },
       "queries.csv:2: query 0: certificate_leaves.csv:7: row 6 of query 0 is out of order"},
      {"DroppedLastRow",
       [](Tables& t) {
         t.certificate.pop_back();
         t.leaves.pop_back();
       },
       "but toc is"},
      {"DroppedFirstRow", [](Tables& t) { drop(t, 1); }, "but toc is"},
      {"NoRows",
       [](Tables& t) {
         t.certificate.resize(1);
         t.leaves.resize(1);
       },
       "queries.csv:2: query 0: the certificate has no row"},
      {"LargerGap", [](Tables& t) { raise(t.certificate[kRow], kGap, 1); },
       "certificate.csv:7: query 0: the gap along the normal is"},
      {"NegativeGap",
       [](Tables& t) { t.certificate[kRow] = with(with(t.certificate[kRow], kGap, -10), kSpeed, -1e9); },
       "certificate.csv:7: query 0: gap_lower is negative"},
      {"LongerAdvance",
       [](Tables& t) {
         t.certificate[kRow] = with(t.certificate[kRow], kAdvance, 1.1 * cell(t.certificate[kRow], kAdvance));
       },
       "certificate.csv:7: query 0: the gap of"},
      {"LongerAdvanceAtLessSpeed",
       [](Tables& t) {
         std::string& row = t.certificate.back();
         row = with(with(row, kAdvance, 1), kSpeed, 0.99 * cell(row, kGap));
       },
       "query 0: the pair closes faster than the speed bound"},
      {"OppositeNormal",
       [](Tables& t) {
         std::string& row = t.certificate[kRow];
         for (const int n : {kNx, kNy, kNz}) row = with(row, n, -cell(row, n));
       },
       "certificate.csv:7: query 0: the gap along the normal is"},
      {"ShiftedLeaves", [](Tables& t) { raise(t.leaves[kRow], 2, 1); },
       "certificate.csv:7: query 0: no nodes have the leaves"},
      {"MoreLeaves", [](Tables& t) { raise(t.leaves[kRow], 5, 1); },
       "certificate.csv:7: query 0: no nodes have the leaves"},
      {"WholeBodies",  // the last row's block becomes that of both roots
       [](Tables& t) {
         int most_a = 0, most_b = 0;
         for (std::size_t k = 1; k < t.leaves.size(); ++k) {
           most_a = std::max(most_a, static_cast<int>(cell(t.leaves[k], 2) + cell(t.leaves[k], 3)));
           most_b = std::max(most_b, static_cast<int>(cell(t.leaves[k], 4) + cell(t.leaves[k], 5)));
         }
         std::string& block = t.leaves.back();
         block = with(with(with(with(block, 2, 0), 3, most_a), 4, 0), 5, most_b);
       },
       "query 0: the gap along the normal is"},
      {"LaterToc", [](Tables& t) { raise(t.queries[1], 2, 1e-9); }, "but toc is"},
      {"Separated",
       [](Tables& t) {
         t.queries[1].replace(t.queries[1].find("contact"), 7, "separated");
         t.queries[1] = with(t.queries[1], 2, 1);
       },
       "but toc is"},
  };
  return all;
}

TEST(HierarchyReplayProgram, RefusesWhatWasChanged) {
  const path scene = kScenes / "interlocked_rings.yaml";
  const path folder = answered(scene, "changed");
  const auto write_all = [&](const Tables& t) {
    write(folder / "queries.csv", t.queries);
    write(folder / "certificate.csv", t.certificate);
    write(folder / "certificate_leaves.csv", t.leaves);
  };
  const Tables honest{lines_of(folder / "queries.csv"), lines_of(folder / "certificate.csv"),
                      lines_of(folder / "certificate_leaves.csv")};
  ASSERT_EQ(honest.certificate.size(), honest.leaves.size());
  for (const Change& change : changes()) {
    Tables t = honest;
    change.make(t);
    write_all(t);
    const Outcome o = replayed(scene, folder);
    EXPECT_EQ(o.exit_code, 3) << change.name << '\n' << o.out << o.err;
    EXPECT_NE(o.err.find(change.expected), std::string::npos) << change.name << '\n' << o.err;
    EXPECT_EQ(o.out.find(", 0 refused"), std::string::npos) << change.name;
  }
  write_all(honest);
  expect_proved(scene, folder);
  // The same certificate for another flight; and one without its leaves.
  EXPECT_EQ(replayed(scene, folder, "--set bodies.1.velocity=[1.1,0,0]").exit_code, 3);
  std::filesystem::remove(folder / "certificate_leaves.csv");
  const Outcome o = replayed(scene, folder);
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_NE(o.err.find("queries.csv:2: query 0: the certificate has"), std::string::npos) << o.err;
}

TEST(HierarchyReplayProgram, BadInputIsOneLine) {
  const path scene = kScenes / "interlocked_rings.yaml";
  const path folder = answered(scene, "bad");
  const Lines honest = lines_of(folder / "certificate_leaves.csv");
  const auto expect_bad = [&](const Outcome& o, const std::string& expected) {
    EXPECT_EQ(o.exit_code, 2) << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_NE(o.err.find(expected), std::string::npos) << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  };
  const auto expect_bad_row = [&](const std::string& row, const std::string& expected) {
    Lines lines = honest;
    lines[2] = row;
    write(folder / "certificate_leaves.csv", lines);
    expect_bad(replayed(scene, folder), "certificate_leaves.csv:3:" + expected);
  };
  expect_bad_row("0,1,x,1,0,1", "5: \"x\" is not a finite number");
  expect_bad_row("0,1,0.5,1,0,1", "5: must be a whole number");
  expect_bad_row("0,1,0,-1,0,1", "7: must be a whole number");
  expect_bad_row("0,1,0,1", "7: 4 cells");
  expect_bad_row("7,0,0,1,0,1", "1: there is no query 7");
  write(folder / "certificate_leaves.csv", honest);
  std::filesystem::remove(folder / "certificate.csv");
  expect_bad(replayed(scene, folder), "certificate.csv: cannot be read");
  expect_bad(replayed(folder / "none.yaml", folder), "none.yaml");
  expect_bad(run(kBin + "/ch02_replay"), "SCENE is required");
}

TEST(HierarchyReplayProgram, HelpHasAnExample) {
  const Outcome o = run(kBin + "/ch02_replay --help");
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_NE(o.out.find("build/bin/ch02_replay chapters/"), std::string::npos);
}

}  // namespace

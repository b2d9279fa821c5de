// ch01_replay proves what chapter 1's executable wrote, and refuses whatever was changed in it.
#include "ch01_convex_advancement/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "tests/support/changed_tables.hpp"

namespace {

using fc::ca::Long;
using fc_test::cell;
using fc_test::contents;
using fc_test::Lines;
using fc_test::lines_of;
using fc_test::Outcome;
using fc_test::run;
using fc_test::scratch;
using fc_test::with;
using fc_test::write;
using std::filesystem::path;

const std::string kBin = FC_BIN_DIR;
const path kSpinningBox = path(FC_SOURCE_DIR) / "chapters/ch01_convex_advancement/scenes/spinning_box.yaml";

std::string quoted(const path& file) {
  return "'" + file.string() + "'";
}

// Runs chapter 1 with a certificate; the folder.
path answered(const path& scene, const std::string& name, const std::string& options = "") {
  const path folder = scratch(name);
  const Outcome o = run(kBin + "/ch01_convex_advancement " + quoted(scene) + " --certificate --quiet " +
                        options + " --out " + quoted(folder));
  EXPECT_EQ(o.exit_code, 0) << o.err;
  return folder;
}

Outcome replayed(const path& scene, const path& folder, const std::string& options = "") {
  return run(kBin + "/ch01_replay " + quoted(scene) + " " + quoted(folder) + " " + options);
}

enum Column { kQuery, kK, kT, kNx, kNy, kNz, kGap, kSpeed, kAdvance };

// 60 flights of two bodies, turning, at each other and past.
path random_scene(const std::string& name, const std::string& shape_a, const std::string& shape_b) {
  const path folder = scratch("scene_" + name);
  std::ofstream(folder / "scene.yaml")
      << "name: " << name << "\ninterval: 1.5\nmotions: motions.csv\nshapes:\n  a: " << shape_a
      << "\n  b: " << shape_b << "\nbodies:\n  - {shape: a}\n  - {shape: b}\n";
  std::mt19937_64 random(11);
  const auto any = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
  std::ofstream motions(folder / "motions.csv");
  for (const char* body : {"a_", "b_"})
    for (const char* column : {"px", "py", "pz", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"})
      motions << (body[0] == 'a' && column == std::string("px") ? "" : ",") << body << column;
  motions << '\n';
  motions.precision(17);
  for (int row = 0; row < 60; ++row) {
    const double fast = row % 3 == 0 ? 30 : row % 3 == 1 ? 3 : 0;
    for (const double x : {-2.0, 2.0}) {
      motions << (x < 0 ? "" : ",") << x << ',' << any(0.7) << ',' << any(0.7);
      for (int i = 0; i < 4; ++i) motions << ',' << any(1);
      motions << ',' << -1.5 * x + any(1) << ',' << any(0.5) << ',' << any(0.5);
      for (int i = 0; i < 3; ++i) motions << ',' << any(fast);
    }
    motions << '\n';
  }
  return folder / "scene.yaml";
}

// A corner on a circle of radius 1 about a centre that flies past, above a ball: along z the gap is
//   3 - cos(5 t + 1) - t + t^2/2 - 0.5,  and whatever it stays above by 1e-12 m is proved, and no more.
TEST(Replay, ProvesWhatIsTrueAndNoMore) {
  fc::ca::ReplayShape ball, corner;
  ball.points = {{0, 0, 0}};
  ball.radius = 0.5L;
  corner.points = {{std::sin(1.0L), 0, -std::cos(1.0L)}};
  corner.reach = 1;
  fc::ca::Motion rest, flight;
  flight.position = {0.25, 0, 3};
  flight.velocity = {7, 0, -1};
  flight.acceleration = {0, 0, 1};
  flight.spin = {0, -5, 0};
  flight.spin_axis = {0, -1, 0};
  flight.spin_rate = 5;
  const fc::ca::ReplayQuery query{ball, corner, rest, flight, 2};
  const auto gap = [](Long t) { return 2.5L - std::cos(5 * t + 1) - t + t * t / 2; };
  for (const Long t : {0.0L, 0.25L, 0.5L})
    for (const Long duration : {0.001L, 0.1L, 1.0L})
      for (const Long speed : {-2.0L, 0.0L, 0.5L, 3.0L, 8.0L}) {
        constexpr int kSamples = 30'000;
        Long room = gap(t);  // the highest line of this slope below the gap
        for (int i = 0; i <= kSamples; ++i) {
          const Long h = duration * i / kSamples;
          room = std::min(room, gap(t + h) + speed * h);
        }
        const auto proof = [&](Long height) {
          return fc::ca::prove_above(query, {0, 0, 1}, t, height, speed, duration);
        };
        const Long between = duration / (2 * kSamples), sampling = 13 * between * between;  // |gap''| <= 26
        EXPECT_TRUE(proof(room - 1e-12L - sampling).proved) << t << ' ' << duration << ' ' << speed;
        EXPECT_FALSE(proof(room + 1e-12L).proved) << t << ' ' << duration << ' ' << speed;
      }
}

TEST(Replay, ProvesEveryKindOfShape) {
  const std::string hull = "{hull: {points: [[0,0,0],[1,0,0.1],[0,0.8,0],[0.2,0.1,0.9],[0.7,0.6,0.5]]}}";
  const std::vector<std::string> kinds = {"{sphere: {radius: 0.4}}",
                                          "{capsule: {radius: 0.2, length: 0.9}}",
                                          "{box: {size: [0.9, 0.6, 0.2]}}",
                                          hull,
                                          "{cylinder: {radius: 0.3, length: 0.8}}",
                                          "{cone: {radius: 0.5, length: 1}}"};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const path scene = random_scene("kind" + std::to_string(i), kinds[i], kinds[(i + 1) % kinds.size()]);
    const path folder = answered(scene, "kind");
    const Outcome o = replayed(scene, folder);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.out.find("60 queries"), std::string::npos) << o.out;
    EXPECT_NE(o.out.find(", 0 refused"), std::string::npos) << o.out;
    const std::string answers = contents(folder / "queries.csv");
    EXPECT_NE(answers.find("contact"), std::string::npos);
    EXPECT_NE(answers.find("separated"), std::string::npos);
  }
}

TEST(Replay, ProvesEveryBoundAndStatus) {
  for (const char* options :
       {"--set ccd.bound=naive", "--set ccd.bound=directional", "--set ccd.bound=projected",
        "--set ccd.bound=second_order", "--set ccd.tolerance=1e-12", "--set ccd.tolerance=0.1",
        "--set ccd.max_iterations=2", "--set interval=0.1", "--set bodies.1.position=[0.3,0,0]",
        "--set bodies.1.velocity=[1.5,0,0]", "--set bodies.1.velocity=[-1.5,0.9,0]"}) {
    const path folder = answered(kSpinningBox, "status", options);
    const Outcome o = replayed(kSpinningBox, folder, options);
    EXPECT_EQ(o.exit_code, 0) << options << '\n' << o.err;
    EXPECT_EQ(o.err, "") << options;
  }
}

// One change to a proved run, and the expected message, with the line.
struct Change {
  std::string name;
  std::function<void(Lines& certificate, Lines& queries)> make;
  std::string expected;
};

const int kRow = 3;  // the line that most changes are about, from 0

std::vector<Change> changes_of_rows() {
  return {
      {"LongerAdvance",
       [](Lines& c, Lines&) { c[kRow] = with(c[kRow], kAdvance, 1.1 * cell(c[kRow], kAdvance)); },
       "certificate.csv:4: query 0: the gap of"},
      {"LongerAdvanceAtLessSpeed",
       [](Lines& c, Lines&) {
         c[kRow] = with(c[kRow], kAdvance, 1);  // s: beyond the contact
         c[kRow] = with(c[kRow], kSpeed, 0.99 * cell(c[kRow], kGap));
       },
       "certificate.csv:4: query 0: the pair closes faster than the speed bound"},
      {"NoSpeed", [](Lines& c, Lines&) { c[kRow] = with(c[kRow], kSpeed, 0); },
       "certificate.csv:4: query 0: the pair closes faster than the speed bound"},
      {"AnotherNormal", [](Lines& c, Lines&) { c[kRow] = with(with(with(c[kRow], kNx, 0), kNy, 0), kNz, 1); },
       "certificate.csv:4: query 0: the gap along the normal is"},
      {"OppositeNormal",
       [](Lines& c, Lines&) {
         for (const int n : {kNx, kNy, kNz}) c[kRow] = with(c[kRow], n, -cell(c[kRow], n));
       },
       "certificate.csv:4: query 0: the gap along the normal is"},
      {"LongNormal", [](Lines& c, Lines&) { c[kRow] = with(c[kRow], kNx, 1e-6 + cell(c[kRow], kNx)); },
       "certificate.csv:4: query 0: the normal's length"},
      // True of bodies that overlap and part: it proves nothing.
      {"NegativeGap",
       [](Lines& c, Lines&) {
         c[kRow] = with(with(c[kRow], kGap, -10), kSpeed, -10 / cell(c[kRow], kAdvance));
       },
       "certificate.csv:4: query 0: gap_lower is negative"},
      {"LargerGap", [](Lines& c, Lines&) { c[1] = with(c[1], kGap, 1e-12 + cell(c[1], kGap)); },
       "certificate.csv:2: query 0: the gap along the normal is"},
      {"LaterTime", [](Lines& c, Lines&) { c[kRow] = with(c[kRow], kT, 1e-12 + cell(c[kRow], kT)); },
       "certificate.csv:4: query 0: it starts at"},
      {"DroppedRow", [](Lines& c, Lines&) { c.erase(c.begin() + kRow); },
       "certificate.csv:4: query 0: it starts at"},
      {"DroppedAndRenumbered",
       [](Lines& c, Lines&) {
         c.erase(c.begin() + kRow);
         for (std::size_t i = kRow; i < c.size(); ++i) c[i] = with(c[i], kK, static_cast<double>(i) - 1);
       },
       "certificate.csv:4: query 0: it starts at"},
      {"DroppedFirstRow", [](Lines& c, Lines&) { c.erase(c.begin() + 1); },
       "certificate.csv:2: query 0: it starts at"},
      {"DroppedLastRow", [](Lines& c, Lines&) { c.pop_back(); }, "but toc is"},
      {"NoRows", [](Lines& c, Lines&) { c.resize(1); }, "queries.csv:2: query 0: the certificate has no row"},
      {"ShuffledRows", [](Lines& c, Lines&) { std::swap(c[kRow], c[kRow + 1]); },
       "certificate.csv:4: row 3 of query 0 is out of order"},
      {"RepeatedRow", [](Lines& c, Lines&) { c.insert(c.begin() + kRow, std::string(c[kRow])); },
       "certificate.csv:5: row 2 of query 0 is out of order"},
  };
}

void claim(Lines& queries, const std::string& status) {
  queries[1].replace(queries[1].find("contact"), 7, status);
}

std::vector<Change> changes_of_answers() {
  return {
      {"LaterToc", [](Lines&, Lines& q) { q[1] = with(q[1], 2, 1e-9 + cell(q[1], 2)); }, "but toc is"},
      {"EarlierToc", [](Lines&, Lines& q) { q[1] = with(q[1], 2, cell(q[1], 2) - 1e-9); }, "beyond toc"},
      {"Separated", [](Lines&, Lines& q) { claim(q, "separated"); }, "queries.csv:2: query 0: toc must be 1"},
      {"SeparatedForAllTime",
       [](Lines&, Lines& q) {
         claim(q, "separated");
         q[1] = with(q[1], 2, 1);
       },
       "but toc is"},
      {"Touching",
       [](Lines&, Lines& q) {
         claim(q, "touching_at_start");
         q[1] = with(q[1], 2, 0);
       },
       "queries.csv:2: query 0: nothing is proved"},
      {"TouchingLater", [](Lines&, Lines& q) { claim(q, "touching_at_start"); },
       "queries.csv:2: query 0: toc must be 0"},
      {"CrossedGaps", [](Lines&, Lines& q) { q[1] = with(q[1], 3, 1); },
       "queries.csv:2: query 0: gap_lower is larger than gap_upper"},
  };
}

void expect_refused(const std::vector<Change>& changes) {
  const path folder = answered(kSpinningBox, "changed");
  const Lines certificate = lines_of(folder / "certificate.csv"), queries = lines_of(folder / "queries.csv");
  ASSERT_GT(certificate.size(), static_cast<std::size_t>(kRow) + 2);
  for (const Change& change : changes) {
    Lines c = certificate, q = queries;
    change.make(c, q);
    write(folder / "certificate.csv", c);
    write(folder / "queries.csv", q);
    const Outcome o = replayed(kSpinningBox, folder);
    EXPECT_EQ(o.exit_code, 3) << change.name << '\n' << o.out << o.err;
    EXPECT_NE(o.err.find(change.expected), std::string::npos) << change.name << '\n' << o.err;
    EXPECT_EQ(o.out.find(", 0 refused"), std::string::npos) << change.name;
  }
  write(folder / "certificate.csv", certificate);
  write(folder / "queries.csv", queries);
  EXPECT_EQ(replayed(kSpinningBox, folder).exit_code, 0);
  // The same certificate for another flight.
  EXPECT_EQ(replayed(kSpinningBox, folder, "--set bodies.1.velocity=[-1.6,0,0]").exit_code, 3);
}

TEST(Replay, RefusesChangedRows) {
  expect_refused(changes_of_rows());
}

TEST(Replay, RefusesChangedAnswers) {
  expect_refused(changes_of_answers());
}

TEST(Replay, BadInputIsOneLine) {
  const path folder = answered(kSpinningBox, "bad");
  const Lines certificate = lines_of(folder / "certificate.csv");
  const auto expect_bad = [&](const Outcome& o, const std::string& expected) {
    EXPECT_EQ(o.exit_code, 2) << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_NE(o.err.find(expected), std::string::npos) << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  };
  const auto expect_bad_row = [&](const std::string& row, const std::string& expected) {
    Lines c = certificate;
    c[2] = row;
    write(folder / "certificate.csv", c);
    expect_bad(replayed(kSpinningBox, folder), expected);
  };
  expect_bad_row("0,1,x,1,0,0,1,1,1", "certificate.csv:3:5: \"x\" is not a finite number");
  expect_bad_row("0,1,0.5,1,0,0,inf,1,1", "certificate.csv:3:15: \"inf\" is not a finite number");
  expect_bad_row("0,1,0.5", "certificate.csv:3:5: 3 cells");
  expect_bad_row("7,0,0.5,1,0,0,1,1,1", "certificate.csv:3:1: there is no query 7");
  write(folder / "certificate.csv", {"query,k"});
  expect_bad(replayed(kSpinningBox, folder), "certificate.csv:1:8: 't [s]' is missing; the header must be");
  std::filesystem::remove(folder / "certificate.csv");
  expect_bad(replayed(kSpinningBox, folder), "certificate.csv: cannot be read");
  expect_bad(replayed(folder / "none.yaml", folder), "none.yaml");
  expect_bad(run(kBin + "/ch01_replay"), "SCENE is required");
  expect_bad(replayed(kSpinningBox, folder, "--fast"), "--fast");
}

TEST(Replay, HelpHasAnExample) {
  const Outcome o = run(kBin + "/ch01_replay --help");
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_NE(o.out.find("build/bin/ch01_replay chapters/"), std::string::npos);
}

}  // namespace

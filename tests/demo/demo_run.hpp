// One run of the demo through its executable, and its tables for the independent overlap check.
#pragma once

#include "support/replay.hpp"
#include "support/run_files.hpp"

namespace fc_test {

inline const std::filesystem::path demo_scene =
    FC_SOURCE_DIR "/chapters/ch04_multibody_stepping/scenes/two_bunnies.yaml";
inline const std::filesystem::path bunny_file = "/usr/share/glmark2/models/bunny.obj";

inline independent::Vec vec(const Table& table, int row, const std::string& prefix) {
  return {table.at(row, prefix + "x"), table.at(row, prefix + "y"), table.at(row, prefix + "z")};
}

// The states of all bodies at each frame's end.
inline std::vector<std::vector<independent::State>> read_poses(const Table& poses, int bodies) {
  std::vector<std::vector<independent::State>> frames(poses.rows() / bodies);
  for (int row = 0; row < poses.rows(); ++row) {
    EXPECT_EQ(poses.at(row, "body"), row % bodies);
    frames[row / bodies].push_back(
        {vec(poses, row, "p"),
         {poses.at(row, "qw"), poses.at(row, "qx"), poses.at(row, "qy"), poses.at(row, "qz")},
         vec(poses, row, "v"),
         vec(poses, row, "w"),
         {}});
  }
  return frames;
}

// Rows of contacts.csv with equal time.
struct Instant {
  double time = 0;
  int first = 0, last = 0;  // rows first .. last - 1
  int frame = 0;            // the frame it lies in: between rows frame and frame + 1 of steps.csv
};

inline std::vector<Instant> read_instants(const Table& contacts, const Table& steps) {
  std::vector<Instant> instants;
  for (int row = 0; row < contacts.rows(); ++row) {
    const double t = contacts.at(row, "t");
    if (instants.empty() || instants.back().time != t) {
      int frame = 0;
      while (steps.at(frame + 1, "t") < t) ++frame;
      instants.push_back({t, row, row, frame});
    }
    instants.back().last = row + 1;
  }
  return instants;
}

struct DemoRun {
  Outcome outcome;
  std::filesystem::path folder;
  Table steps, contacts, poses;
  std::vector<std::vector<independent::State>> frames;
  std::vector<Instant> instants;
  std::vector<independent::Solid> bunnies;  // one for each body
};

inline DemoRun run_demo(const std::string& name) {
  DemoRun demo;
  demo.folder = scratch(name);
  demo.outcome = run("'" FC_BIN_DIR "/ch04_multibody_stepping' '" + demo_scene.string() +
                     "' --poses --out '" + demo.folder.string() + "'");
  demo.steps = read_table(demo.folder / "steps.csv");
  demo.contacts = read_table(demo.folder / "contacts.csv");
  demo.poses = read_table(demo.folder / "poses.csv");
  demo.frames = read_poses(demo.poses, 2);
  demo.instants = read_instants(demo.contacts, demo.steps);
  const independent::Solid bunny = independent::make_solid(independent::read_obj(bunny_file), 1000);
  demo.bunnies = {bunny, bunny};
  return demo;
}

}  // namespace fc_test

#define FC_SKIP_WITHOUT_THE_BUNNY()                  \
  if (!std::filesystem::exists(fc_test::bunny_file)) \
  GTEST_SKIP() << fc_test::bunny_file << " is missing; the package glmark2-data has it"

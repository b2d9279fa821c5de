// The program on scenes. Without friction, or with a friction of 0, it is chapter 5's, to the byte; and its gallery.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/run_files.hpp"

namespace {

using namespace fc_test;

TEST(Program, WithoutFrictionIsChapterFive) {
  const auto folder = scratch("both");
  const std::string scenes = FC_SOURCE_DIR "/chapters/ch05_resting_contact/scenes/";
  int looked = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string name = entry.path().stem();
    const std::string more = " --poses --quiet --set step.duration=0.25 --out ";
    ASSERT_EQ(
        run(FC_BIN_DIR "/ch05_resting_contact " + entry.path().string() + more + (folder / "five").string())
            .exit_code,
        0)
        << name;
    for (const std::string friction : {"", " --set friction=0"}) {
      ASSERT_EQ(run(FC_BIN_DIR "/ch06_friction " + entry.path().string() + friction + more +
                    (folder / "six").string())
                    .exit_code,
                0)
          << name;
      for (const char* table : {"poses.csv", "contacts.csv"})
        EXPECT_EQ(contents(folder / "five" / table), contents(folder / "six" / table))
            << name << ": " << table << friction;
      EXPECT_EQ(without_times(read_table(folder / "five" / "steps.csv")),
                without_times(read_table(folder / "six" / "steps.csv")))
          << name << friction;
      ++looked;
    }
  }
  EXPECT_GT(looked, 10);
}

// The last poses of a scene of the gallery.
Table last_poses(const std::string& scene, const std::string& more = "") {
  const auto folder = scratch(scene);
  EXPECT_EQ(run(FC_BIN_DIR "/ch06_friction " FC_SOURCE_DIR "/chapters/ch06_friction/scenes/" + scene +
                ".yaml --poses --quiet" + more + " --out " + folder.string())
                .exit_code,
            0);
  const Table poses = read_table(folder / "poses.csv");
  const Table steps = read_table(folder / "steps.csv");
  for (int row = 0; row < steps.rows(); ++row) EXPECT_EQ(steps.at(row, "lost_time"), 0) << scene;
  Table last{poses.columns, {}};
  for (int row = 0; row < poses.rows(); ++row)
    if (poses.cells[row][0] == poses.cells.back()[0]) last.cells.push_back(poses.cells[row]);
  return last;
}

// One falls onto the next, all the way.
TEST(Gallery, DominoesFallInAWave) {
  const Table poses = last_poses("dominoes");
  ASSERT_EQ(poses.rows(), 22);
  for (int body = 2; body < 22; ++body) {
    const double x = poses.at(body, "qx"), y = poses.at(body, "qy");
    EXPECT_LT(1 - 2 * (x * x + y * y), 0.45) << "the height of its upper end: domino " << body - 1;
    EXPECT_NEAR(poses.at(body, "py"), 0, 0.02) << "m: it falls straight";
  }
}

// An arch stands or falls by its friction: 0.3056 is the least, and a little more where stones are smaller.
TEST(Gallery, AnArchNearItsLimit) {
  const auto fastest = [](const Table& poses) {
    double speed = 0;
    for (int body = 0; body < poses.rows(); ++body)
      speed = std::max(speed, std::hypot(poses.at(body, "vx"), poses.at(body, "vz")));
    return speed;
  };
  EXPECT_EQ(fastest(last_poses("arch", " --set friction=0.31")), 0) << "m/s";
  EXPECT_GT(fastest(last_poses("arch", " --set friction=0.3")), 0.05) << "m/s";
  EXPECT_EQ(fastest(last_poses("arch_25")), 0) << "m/s";
}

}  // namespace

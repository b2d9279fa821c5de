// A world that runs on the clear versions of chapters 1 to 4, against the same world on the fast ones; and the program
// with --clear and --mine.
#include "ch04_multibody_stepping/on_pieces.hpp"
#include "events.hpp"
#include "support/gallery.hpp"

namespace {

using namespace fc_test;
namespace fs = std::filesystem;

const fs::path scenes = FC_SOURCE_DIR "/chapters/ch04_multibody_stepping/scenes";

// The impacts of a scene's first frames, on pieces or on the fast versions.
Events impacts_of(const std::string& name, int frames, bool on_pieces, fc::world::World& world) {
  static const fc::world::clear::Pieces pieces;
  const fc::Scene scene = fc::read_scene({scenes / (name + ".yaml"), {}, {}, 4});
  world = fc::world::build_world(scene);
  if (on_pieces) fc::world::put_on_pieces(world, scene, pieces);
  return run_world(world, scene.step->dt, frames);
}

struct Comparison {
  const char* scene;
  int frames;
  double seconds, metres;  // how far times of impacts, and places at the end, may differ
};

class OnPieces : public testing::TestWithParam<Comparison> {};

TEST_P(OnPieces, TheSameImpactsHappen) {
  const Comparison& c = GetParam();
  fc::world::World fast, clear;
  const Events expected = impacts_of(c.scene, c.frames, false, fast);
  const Events found = impacts_of(c.scene, c.frames, true, clear);
  expect_sound(found);
  ASSERT_GT(expected.all.size(), 0U);
  ASSERT_EQ(found.all.size(), expected.all.size()) << "impacts";
  for (std::size_t i = 0; i < expected.all.size(); ++i) {
    ASSERT_NEAR(found.all[i].t, expected.all[i].t, c.seconds) << "s, impact " << i;
    EXPECT_GE(found.all[i].contact.gap, 0) << "m, impact " << i;  // 0: the cradle begins so
  }
  for (std::size_t i = 0; i < fast.bodies.size(); ++i)
    EXPECT_LT((body(clear, static_cast<int>(i)).position - body(fast, static_cast<int>(i)).position).norm(),
              c.metres)
        << "m, body " << i;
}

INSTANTIATE_TEST_SUITE_P(Scenes, OnPieces,
                         testing::Values(Comparison{"cradle", 60, 1e-9, 1e-9},
                                         Comparison{"bounce", 120, 1e-5, 1e-4},
                                         Comparison{"pi", 20, 1e-9, 1e-6},
                                         Comparison{"dominoes", 60, 1e-5, 1e-4},
                                         Comparison{"paddle", 40, 1e-5, 1e-4}),
                         [](const auto& c) { return std::string(c.param.scene); });

fc_test::Outcome bunnies(const fs::path& out, const std::string& options) {
  return run(FC_BIN_DIR "/ch04_multibody_stepping " + (scenes / "two_bunnies.yaml").string() +
             " --poses --out " + out.string() + " " + options);
}

TEST(OnPieces, TwoBunniesCollideAsEverAndDoNotOverlap) {
  FC_SKIP_WITHOUT_THE_BUNNY();
  const fs::path fast = scratch("fast"), clear = scratch("clear");
  const std::vector<std::string> seconds = {"step.duration=0.8"};
  ASSERT_EQ(bunnies(fast, options_of(seconds)).exit_code, 0);
  const Outcome o = bunnies(clear, options_of(seconds) + " --clear");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  expect_no_overlap(scenes / "two_bunnies.yaml", seconds, 4, clear);
  const Table expected = read_table(fast / "contacts.csv"), found = read_table(clear / "contacts.csv");
  ASSERT_EQ(found.rows(), expected.rows());
  for (int row = 0; row < found.rows(); ++row) {
    EXPECT_NEAR(found.at(row, "t"), expected.at(row, "t"), 1e-6) << "s, contact " << row;
    EXPECT_NEAR(found.at(row, "impulse"), expected.at(row, "impulse"), 1e-3 * expected.at(row, "impulse"));
  }
}

// The book's functions, compiled as a learner's are, put where exercises/check.py puts those.
TEST(OnPieces, MineOnTheBooksPiecesWritesTheSameFiles) {
  FC_SKIP_WITHOUT_THE_BUNNY();
  const fs::path mine = scratch("mine"),
                 source = FC_SOURCE_DIR "/README.md";  // a file that does not change meanwhile
  for (const std::string piece : {"ch01_ex06", "ch01_ex07", "ch01_ex08", "ch02_ex05", "ch02_ex06",
                                  "ch03_ex06", "ch04_ex06", "ch04_ex07"}) {
    fs::copy_file(fs::path(FC_BOOK_PIECES) / (piece + ".so"), mine / (piece + ".so"));
    std::ofstream(mine / (piece + ".source")) << source.string() << "\n" << contents(source);
  }
  setenv("FC_MINE", mine.c_str(), 1);
  const fs::path ours = scratch("ours"), theirs = scratch("theirs");
  const std::string seconds = " --set step.duration=0.6";
  ASSERT_EQ(bunnies(ours, "--clear --quiet" + seconds).exit_code, 0);
  const Outcome o = bunnies(theirs, "--mine" + seconds);
  unsetenv("FC_MINE");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  EXPECT_NE(o.out.find("yours"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("the book's"), std::string::npos) << o.out;
  for (const char* file : {"contacts.csv", "poses.csv", "motion.glb"})
    EXPECT_EQ(contents(ours / file), contents(theirs / file)) << file;
}

TEST(OnPieces, WhatTheClearSearchDoesNotKnowIsRefusedInALine) {
  const Outcome tops = run(FC_BIN_DIR "/ch04_multibody_stepping " + (scenes / "tops.yaml").string() +
                           " --clear --out " + scratch("tops").string());
  EXPECT_EQ(tops.exit_code, 2) << tops.out;
  EXPECT_NE(tops.err.find("run without --clear and --mine"), std::string::npos) << tops.err;
  EXPECT_NE(tops.err.find("tops.yaml:"), std::string::npos) << "its line is named: " << tops.err;
}

}  // namespace

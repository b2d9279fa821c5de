// Without friction, or with a friction of 0, the program is chapter 5's, to the byte.
#include <gtest/gtest.h>

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

}  // namespace

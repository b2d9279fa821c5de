// The law of the table of scene keys: a key that a chapter's program accepts makes a difference to what it writes; all
// others are refused, with a line that says where they would have an effect. The same for options.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/options.hpp"
#include "common/scene_keys.hpp"
#include "tests/support/run_files.hpp"
#include "trials.hpp"

namespace {

namespace fs = std::filesystem;
using fc_test::Trial;

const std::vector<std::string> programs = {"ch01_convex_advancement", "ch02_hull_hierarchy",
                                           "ch03_impulse_lcp",        "ch04_multibody_stepping",
                                           "ch05_resting_contact",    "ch06_friction"};
constexpr int chapters = 6;

std::string in_ticks(const std::string& text) {
  return "'" + text + "'";
}

class EveryKey : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    here_ = fc_test::scratch("keys_" + std::to_string(GetParam()));
    for (const auto& [name, text] : fc_test::files()) std::ofstream(here_ / name) << text;
  }

  fc_test::Outcome run(const std::string& arguments) const {
    return fc_test::run("cd " + in_ticks(here_.string()) + " && rm -rf out && " FC_BIN_DIR "/" +
                        programs[static_cast<std::size_t>(GetParam() - 1)] + " scene.yaml --out out " +
                        arguments);
  }
  fc_test::Outcome run(const Trial& trial, const std::string& value) const {
    std::ofstream(here_ / "scene.yaml")
        << (trial.scene.empty() ? fc_test::scene_of(GetParam()) : trial.scene);
    std::string sets;
    for (const std::string& set : trial.sets) sets += " --set " + in_ticks(set);
    if (!value.empty()) sets += " --set " + in_ticks(trial.key + "=" + value);
    return run(sets);
  }

  // All that the run wrote, measured times left out.
  std::string results() const {
    std::vector<fs::path> files;
    if (fs::exists(here_ / "out"))
      for (const auto& entry : fs::directory_iterator(here_ / "out")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::string text;
    for (const fs::path& file : files) {
      text += file.filename().string() + "\n";
      if (file.extension() == ".csv")
        text += fc_test::without_times(fc_test::read_table(file));
      else if (file.extension() == ".json")
        text += timeless(nlohmann::json::parse(fc_test::contents(file))).dump();
      else
        text += fc_test::contents(file);
    }
    return text;
  }

  fs::path here_;

 private:
  static nlohmann::json timeless(nlohmann::json json) {
    for (auto& [name, counter] : json["counters"].items()) counter.erase("ns");
    std::vector<std::string> times;
    for (auto& [name, entry] : json["entries"].items())
      if (entry["unit"] == "ns" || name.find("of a frame") != std::string::npos) times.push_back(name);
    for (const std::string& name : times) json["entries"].erase(name);
    json["entries"].erase("frames over 1/30 s");
    return json;
  }
};

bool one_line(const std::string& text) {
  return !text.empty() && text.find('\n') + 1 == text.size();
}

TEST_P(EveryKey, MakesADifferenceOrIsRefused) {
  for (const fc::SceneKey& key : fc::scene_keys()) {
    SCOPED_TRACE(key.path);
    const auto trial = fc_test::trial_of(key.path, GetParam());
    ASSERT_TRUE(trial) << "write a trial for this key in tests/keys/trials.cpp";
    if (!key.known_in(GetParam())) {
      // A key of a shape's kind needs that kind.
      const std::vector<std::string> sets =
          key.path.starts_with("shapes") ? trial->sets : std::vector<std::string>{};
      const fc_test::Outcome refused = run(Trial{trial->key, "", "", sets}, trial->other);
      EXPECT_EQ(refused.exit_code, 2);
      EXPECT_TRUE(one_line(refused.err)) << refused.err;
      EXPECT_NE(refused.err.find("chapter"), std::string::npos) << "where has it an effect? " << refused.err;
      continue;
    }
    const fc_test::Outcome one = run(*trial, trial->value);
    const std::string first = results();
    const fc_test::Outcome two = run(*trial, trial->other);
    EXPECT_NE(one.exit_code, 2) << one.err;
    EXPECT_NE(two.exit_code, 2) << two.err;
    EXPECT_NE(first, results()) << trial->key << " = " << trial->value << " or " << trial->other
                                << " made no difference";
  }
}

// The test above can fail: the same scene twice makes no difference.
TEST_P(EveryKey, TheSameSceneWritesTheSame) {
  const Trial nothing{"name", "same", "same"};
  ASSERT_EQ(run(nothing, "same").exit_code, 0);
  const std::string first = results();
  ASSERT_EQ(run(nothing, "same").exit_code, 0);
  EXPECT_EQ(first, results());
  EXPECT_GT(first.size(), 100U);
}

TEST_P(EveryKey, BesideAnotherThatMakesItIdleIsRefused) {
  for (const fc::SceneKey& key : fc::scene_keys()) {
    if (key.idle_beside.empty() || !key.known_in(GetParam())) continue;
    if (!fc::find_scene_key(key.idle_beside)->known_in(GetParam())) continue;
    SCOPED_TRACE(key.path);
    Trial beside = *fc_test::trial_of(key.idle_beside, GetParam());
    beside.sets.push_back(beside.key + "=" + beside.value);
    const Trial own = *fc_test::trial_of(key.path, GetParam());
    beside.key = own.key;
    EXPECT_EQ(run(beside, "").exit_code, 0);
    const fc_test::Outcome refused = run(beside, own.value);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("no effect beside '" + key.idle_beside + "'"), std::string::npos)
        << refused.err;
  }
}

TEST_P(EveryKey, AnOptionMakesADifferenceOrIsRefused) {
  fs::create_directories(here_ / "meshes");
  fs::copy_file(here_ / "one.obj", here_ / "meshes/elsewhere.obj", fs::copy_options::overwrite_existing);
  for (const fc::ChapterOption& option : fc::chapter_options()) {
    SCOPED_TRACE(option.name);
    const bool path = option.name == "--mesh-path";
    const bool known = option.first <= GetParam() && GetParam() <= option.last;
    if (known && option.name == "--live") continue;  // it serves pages and leaves no results: see tests/live
    Trial trial{"name", "same", "same"};
    if (path && known) trial.sets = {"shapes.b={mesh: elsewhere.obj, mass: 1}"};
    const int without = run(trial, "same").exit_code;
    const std::string first = results();
    const fc_test::Outcome outcome = run(
        "--set name=same " + (path && known ? "--set " + in_ticks(trial.sets[0]) : "") + " " + option.name +
        (path                           ? " meshes"
         : option.name == "--algorithm" ? " 2"
                                        : ""));
    if (known) {
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(without, path ? 2 : 0);
      EXPECT_NE(first, results()) << "it made no difference";
    } else {
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_TRUE(one_line(outcome.err)) << outcome.err;
      EXPECT_TRUE(outcome.err.starts_with(option.name + " has no effect in chapter")) << outcome.err;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Chapters, EveryKey, testing::Range(1, chapters + 1),
                         [](const auto& chapter) { return "ch0" + std::to_string(chapter.param); });

}  // namespace

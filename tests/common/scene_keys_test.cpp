#include "common/scene_keys.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "common/scene_values.hpp"
#include "common/yaml_tree.hpp"

namespace {

const std::string page = std::string(FC_SOURCE_DIR) + "/common/SCENE_KEYS.md";

TEST(SceneKeys, EveryExampleIsAllowedByItsOwnRow) {
  for (const fc::SceneKey& key : fc::scene_keys()) {
    const auto node = fc::parse_yaml(key.example, std::make_shared<const std::string>(key.path), true);
    EXPECT_NO_THROW(fc::check_value(*node, key)) << key.path;
  }
}

TEST(SceneKeys, EveryRowIsCompleteAndStandsOnce) {
  std::set<std::string> paths;
  for (const fc::SceneKey& key : fc::scene_keys()) {
    EXPECT_TRUE(paths.insert(key.path).second) << key.path;
    EXPECT_FALSE(key.fallback.empty()) << key.path;
    EXPECT_FALSE(key.example.empty()) << key.path;
    EXPECT_TRUE(key.meaning.ends_with('.')) << key.path;
    EXPECT_LE(key.first, key.last) << key.path;
    EXPECT_EQ(fc::find_scene_key(key.path), &key);
    EXPECT_EQ(fc::find_later_name(key.last_name()), nullptr) << key.path;
    EXPECT_EQ(key.type == fc::KeyType::choice || key.type == fc::KeyType::words, !key.choices.empty())
        << key.path;
  }
}

TEST(SceneKeys, KeysBelowAParentAreThoseTheChapterKnows) {
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  EXPECT_TRUE(has(fc::scene_keys_below("", 4), "gravity"));
  EXPECT_FALSE(has(fc::scene_keys_below("", 3), "gravity"));
  EXPECT_FALSE(has(fc::scene_keys_below("", 4), "interval"));
  EXPECT_EQ(fc::scene_keys_below("bodies[].grid", 1), (std::vector<std::string>{"count", "spacing"}));
}

TEST(SceneKeys, HelpListsExactlyTheChaptersKeys) {
  const std::string help = fc::scene_keys_help(1);
  EXPECT_NE(help.find("shapes.<name>.sphere.radius"), std::string::npos);
  EXPECT_EQ(help.find("gravity"), std::string::npos);
}

// FC_WRITE_PAGES=1 writes the page instead.
TEST(SceneKeys, ThePageIsNotStale) {
  if (std::getenv("FC_WRITE_PAGES")) std::ofstream(page) << fc::scene_keys_markdown();
  std::ifstream stream(page);
  const std::string committed{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(committed, fc::scene_keys_markdown())
      << "common/SCENE_KEYS.md is stale: run this test with FC_WRITE_PAGES=1";
}

}  // namespace

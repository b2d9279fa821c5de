// Every broken scene of tests/data/broken_scenes is refused with exactly the message that expected.txt lists.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "common/scene.hpp"

namespace {

const std::filesystem::path folder = std::filesystem::path(FC_SOURCE_DIR) / "tests/data/broken_scenes";

struct Case {
  std::string file;
  int chapter = 0;
  std::string message;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::vector<Case> cases() {
  std::vector<Case> list;
  std::ifstream stream(folder / "expected.txt");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t first = line.find(" | "), second = line.find(" | ", first + 3);
    Case c{line.substr(0, first), std::stoi(line.substr(first + 3, second - first - 3)),
           line.substr(second + 3)};
    c.message = replaced(c.message, "{file}", (folder / c.file).string());
    c.message = replaced(c.message, "{folder}", folder.string());
    list.push_back(c);
  }
  return list;
}

std::string refusal(const std::filesystem::path& file, int chapter) {
  try {
    fc::read_scene({file, {}, {}, chapter});
    return "accepted";
  } catch (const fc::InputError& error) {
    return error.what();
  }
}

TEST(BrokenScenes, EachIsRefusedWithItsMessage) {
  const std::vector<Case> list = cases();
  ASSERT_GE(list.size(), 100u);
  for (const Case& c : list) EXPECT_EQ(refusal(folder / c.file, c.chapter), c.message);
}

TEST(BrokenScenes, EveryMessageIsOneLineThatSaysWhatToDo) {
  for (const Case& c : cases()) {
    const std::string message = refusal(folder / c.file, c.chapter);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find("; "), std::string::npos) << message;
  }
}

TEST(BrokenScenes, TheListAndTheFolderAgree) {
  std::set<std::string> listed;
  for (const Case& c : cases()) EXPECT_TRUE(listed.insert(c.file).second) << c.file << " is listed twice";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "expected.txt" || listed.count(name)) << name << " is not in expected.txt";
  }
}

}  // namespace

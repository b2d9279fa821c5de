// Whatever bytes a scene file holds, reading it ends in a Scene or an InputError of one line.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/scene_keys.hpp"
#include "scene_files.hpp"

namespace {

const std::string rich =
    "name: x\nstep: {dt: 0.01, duration: 1}\ngravity: [0, 0, -9.81]\nrestitution: 0.5\nccd: {tolerance: "
    "1e-6}\n"
    "shapes:\n  a: {sphere: {radius: 0.5}, mass: 1}\n  b: {box: {size: [1, 1, 1]}, density: 10}\n"
    "  c: {hull: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}, mass: 1, inertia: [1, 1, 1]}\n"
    "bodies:\n  - {shape: a, position: &p [1, 2, 3], orientation: [1, 0, 0, 0]}\n  - {shape: b, position: "
    "*p, static: true}\n"
    "  - {shape: c, grid: {count: [2, 2, 1], spacing: [1, 1, 1]}, spin: [0, 0, 1]}\n";

void reads_or_refuses(const std::string& text, int chapter, const std::vector<std::string>& overrides = {}) {
  try {
    fc_test::read_text(text, chapter, overrides);
  } catch (const fc::InputError& error) {
    RC_ASSERT(std::string(error.what()).find('\n') == std::string::npos);
  }
}

RC_GTEST_PROP(RandomScenes, RandomBytes, (const std::string& bytes)) {
  reads_or_refuses(bytes, 4);
}

// Text of the characters that mean something in YAML gets past the scanner more often.
RC_GTEST_PROP(RandomScenes, RandomYaml, ()) {
  const auto pieces = *rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
      ": ", "- ", "\n", "\n  ", "[", "]", "{", "}", ", ", "\"", "'", "&a ", "*a", "!", "|\n ", ">", "#", "? ",
      "%", "---\n", "...\n", "~", "1", "1e5", "name", "shapes", "bodies", "sphere", "radius", "shape", "<<",
      "\t", "é"));
  std::string text;
  for (const std::string& piece : pieces) text += piece;
  reads_or_refuses(text, *rc::gen::inRange(1, 6));
}

RC_GTEST_PROP(RandomScenes, MutatedBytes, ()) {
  std::string text = rich;
  const int changes = *rc::gen::inRange(1, 6);
  for (int i = 0; i < changes; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    switch (*rc::gen::inRange(0, 4)) {
      case 0:
        text[at] = *rc::gen::arbitrary<char>();
        break;
      case 1:
        text[at] = *rc::gen::elementOf(std::string("[]{}:,-'\"&*!|>#%~0123456789. \n\t"));
        break;
      case 2:
        text.erase(at, *rc::gen::inRange<std::size_t>(1, 20));
        break;
      default:
        text.insert(at, text.substr(*rc::gen::inRange<std::size_t>(0, text.size()), 15));
        break;
    }
    if (text.empty()) break;
  }
  reads_or_refuses(text, 4);
}

// Every key of the table with every kind of wrong value, through --set.
RC_GTEST_PROP(RandomScenes, AnyValueForAnyKey, ()) {
  std::vector<std::string> paths = {"shapes.a", "bodies.0", "bodies.9.shape", "x"};
  for (const fc::SceneKey& key : fc::scene_keys()) {
    std::string path = key.path;
    if (const auto at = path.find("<name>"); at != std::string::npos) path.replace(at, 6, "a");
    if (const auto at = path.find("[]"); at != std::string::npos) path.replace(at, 2, ".0");
    paths.push_back(path);
  }
  const std::string value = *rc::gen::element<std::string>(
      "", "1", "-1", "0", "1e999", "1e308", "-1e308", ".nan", "true", "text", "'1'", "[]", "{}", "[[]]",
      "[1, 2, 3]", "[1e8, 1e8, 1e8]", "[1000000, 1000000, 1000000]", "[0, 0, 0, 0]", "{a: 1}", "[a]", "~",
      "[~, ~, ~]", "{count: 1}", "[[1, 2, 3]]", "\x01", "[{}]");
  reads_or_refuses(rich, *rc::gen::inRange(1, 6), {*rc::gen::elementOf(paths) + "=" + value});
}

TEST(RandomScenes, TheSceneThatIsMutatedIsGood) {
  EXPECT_EQ(fc_test::refusal(rich, 4), "accepted");
}

TEST(RandomScenes, DeepAndLongTextsEndSoon) {
  for (const char* piece : {"[", "{a: ", "- ", "? ", "a: &a [*a, ", "&a ", "!a ", "\"", "a:\n  ", "- - "}) {
    std::string text;
    for (int i = 0; i < 20000; ++i) text += piece;
    EXPECT_NE(fc_test::refusal(text, 4), "accepted") << piece;
  }
}

}  // namespace

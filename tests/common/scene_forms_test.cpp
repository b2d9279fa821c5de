// Scenes as people's editors write them.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/scene.hpp"
#include "tests/support/text_forms.hpp"

namespace fc {
namespace {

const std::filesystem::path kFile =
    std::filesystem::path(testing::TempDir()) / ("fc_scene_forms_" + std::to_string(getpid()) + ".yaml");

Scene read(const std::string& bytes) {
  std::ofstream(kFile, std::ios::binary) << bytes;
  return read_scene({kFile, {}, {}, 4});
}

std::string refusal(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(kFile.string().size());
  }
  return "read";
}

std::string scene(const std::string& three) {
  return "name: forms\nstep: {dt: 0.1, duration: 1}\n# a remark\nshapes:\n  ball: {sphere: {radius: 1}, mass: " +
         three + "}\nbodies:\n  - {shape: ball}\n  - shape: ball\n    position:\n      - 5\n      - " +
         three + "\n      - 0\n";
}

TEST(SceneForms, MarksAndLineEndsChangeNothing) {
  for (const auto& [form, bytes] : fc_test::forms_of(scene("3"))) {
    const Scene read_back = read(bytes);
    EXPECT_EQ(read_back.name, "forms") << form;
    EXPECT_EQ(*read_back.shapes.at(0).mass, 3) << form;
    ASSERT_EQ(read_back.bodies.size(), 2u) << form;
    EXPECT_EQ(read_back.bodies[1].position, Vec3(5, 3, 0)) << form;
  }
  for (const auto& [form, bytes] : fc_test::forms_of(scene("three")))
    EXPECT_TRUE(refusal(bytes).starts_with(":5:37: 'mass' must be a number in kg, found the text 'three'"))
        << form;
}

// Scenes take decimal numbers: people and programs disagree about what 010 and 0x3 mean.
TEST(SceneForms, FormsOfNumbersChangeNothing) {
  for (const std::string& three : fc_test::kThrees) {
    if (three.find_first_of("xX") == std::string::npos)
      EXPECT_EQ(read(scene(three)).bodies[1].position, Vec3(5, 3, 0)) << three;
    else
      EXPECT_NE(refusal(scene(three)).find("'" + three + "', which is not a plain decimal number"),
                std::string::npos)
          << three;
  }
  for (const std::string& no_number : fc_test::kNoNumbers)
    EXPECT_NE(refusal(scene(no_number)), "read") << no_number;
}

TEST(SceneForms, WhatIsNoSceneIsNamed) {
  std::string utf16;
  for (char c : scene("3")) utf16 += {c, '\0'};
  EXPECT_EQ(refusal("\xff\xfe" + utf16), ": is UTF-16 text, not a scene; save it as UTF-8");
  EXPECT_EQ(refusal(utf16), ": is UTF-16 text, not a scene; save it as UTF-8");
  EXPECT_EQ(refusal("\x1f\x8b\x08 packed"), ": is gzip data, not a scene; unpack it first");
  EXPECT_EQ(refusal("<!doctype html>"), ": is a web page, not a scene; fetch the file itself");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\n"), ": is an OBJ mesh, not a scene; name it .obj");
  EXPECT_EQ(refusal("solid a\nfacet normal 0 0 1\n"), ": is an STL mesh, not a scene; name it .stl");
}

}  // namespace
}  // namespace fc

// Scenes written to temporary files, for the tests of this folder.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/scene.hpp"

namespace fc_test {

// A folder of this process (tests run in parallel), removed at its end.
inline std::filesystem::path folder() {
  struct TemporaryFolder {
    std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / ("first_contact_" + std::to_string(getpid()));
    TemporaryFolder() { std::filesystem::create_directories(path); }
    ~TemporaryFolder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const TemporaryFolder temporary;
  return temporary.path;
}

inline std::filesystem::path write_file(const std::string& name, const std::string& text) {
  std::filesystem::create_directories((folder() / name).parent_path());
  std::ofstream(folder() / name, std::ios::binary) << text;
  return folder() / name;
}

// The scene that the text describes, with overrides.
inline fc::Scene read_text(const std::string& text, int chapter,
                           const std::vector<std::string>& overrides = {}) {
  return fc::read_scene({write_file("scene.yaml", text), overrides, {}, chapter});
}

// The message that refuses it, after the file's name; "accepted" if none does.
inline std::string refusal(const std::string& text, int chapter,
                           const std::vector<std::string>& overrides = {}) {
  try {
    read_text(text, chapter, overrides);
    return "accepted";
  } catch (const fc::InputError& error) {
    const std::string message = error.what(), file = (folder() / "scene.yaml").string();
    return message.starts_with(file) ? message.substr(file.size()) : message;
  }
}

inline const std::string one_ball =
    "step: {dt: 0.01, duration: 1}\n"
    "shapes:\n"
    "  ball: {sphere: {radius: 0.5}, mass: 1}\n"
    "bodies:\n"
    "  - {shape: ball, position: [0, 0, 1]}\n";

inline const std::string two_balls =
    "shapes: {ball: {sphere: {radius: 0.5}}}\n"
    "bodies:\n"
    "  - {shape: ball, velocity: [1, 0, 0]}\n"
    "  - {shape: ball, position: [3, 0, 0]}\n";

}  // namespace fc_test

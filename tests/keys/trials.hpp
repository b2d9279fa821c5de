// For every scene key a scene in which it matters, and two values of it that must make a difference.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace fc_test {

struct Trial {
  std::string key;    // concrete: "shapes.b.sphere.radius"
  std::string value;  // as after --set KEY=; "" = the key is absent
  std::string other;
  std::vector<std::string> sets = {};  // what else the scene needs: "shapes.b={sphere: {radius: 0.5}}"
  std::string scene = {};              // instead of the chapter's own, whole
};

// The chapter's own scene: two bodies that meet; in chapter 3, that touch.
std::string scene_of(int chapter);

// The trial of a row of the table of scene keys ("shapes.<name>.sphere.radius"); none: one must be written.
std::optional<Trial> trial_of(const std::string& path, int chapter);

// The files that the scenes name: file by file its name and text.
std::vector<std::pair<std::string, std::string>> files();

}  // namespace fc_test

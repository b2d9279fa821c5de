// The generic check of a scene's tree against the table of scene keys.
#pragma once

#include <map>
#include <string>

#include "common/yaml_tree.hpp"

namespace fc {

// Refuses, at the node: an unknown key, a key that the chapter does not know, a missing required key, and
// every value that its row of the table does not allow. Returns the mark of every key present, by its dotted
// path.
std::map<std::string, SourceMark> check_scene_keys(const YamlNode& scene, int chapter);

}  // namespace fc

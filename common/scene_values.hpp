// Typed access to the values of a scene's tree, each checked against its row of the table of scene keys.
//
// Numbers are read here and not by yaml-cpp, which takes "1.5" in quotes for a number and 010 for eight or
// ten.
#pragma once

#include <array>
#include <vector>

#include "common/scene_keys.hpp"
#include "common/types.hpp"
#include "common/yaml_tree.hpp"

namespace fc {

// Each throws InputError at the value: a wrong type, a non-finite number, out of range.
std::string text_value(const YamlNode& node, const SceneKey& key);
bool boolean_value(const YamlNode& node, const SceneKey& key);
int integer_value(const YamlNode& node, const SceneKey& key);
double number_value(const YamlNode& node, const SceneKey& key);
Vec3 vector_value(const YamlNode& node, const SceneKey& key);
std::array<int, 3> integers_value(const YamlNode& node, const SceneKey& key);
Quat quaternion_value(const YamlNode& node, const SceneKey& key);  // normalised
Vec3 direction_value(const YamlNode& node, const SceneKey& key);   // a vector3, made unit; not zero
// A body's number, from its number or its name. `names`: one for each body; empty: it has none.
int body_value(const YamlNode& node, const SceneKey& key, const std::vector<std::string>& names);
std::vector<std::string> words_value(const YamlNode& node, const SceneKey& key);
Mat3 inertia_value(const YamlNode& node, const SceneKey& key);
std::vector<Vec3> points_value(const YamlNode& node, const SceneKey& key);
VecX numbers_value(const YamlNode& node, const SceneKey& key);
MatX matrix_value(const YamlNode& node, const SceneKey& key);

// Refuses a value that its key's row of the table does not allow.
void check_value(const YamlNode& node, const SceneKey& key);

// Refuses a node that should have been `expected`, saying what it is instead and how to write the key.
[[noreturn]] void refuse_type(const YamlNode& node, const SceneKey& key, const std::string& expected);

// A map of a scene whose keys have been checked: access by key.
class Section {
 public:
  // `pattern` is the map's path in the table ("shapes.<name>", "" for the scene itself).
  Section(const YamlNode& map, std::string pattern) : map_(map), pattern_(std::move(pattern)) {}

  bool has(const std::string& key) const { return map_.find(key) != nullptr; }
  const YamlNode::Entry& entry(const std::string& key) const { return *map_.find(key); }
  const YamlNode& node(const std::string& key) const { return *entry(key).value; }
  const YamlPlace& place() const { return map_.place; }
  // The row of the table of a key of this map, or nullptr.
  const SceneKey* find_row(const std::string& key) const {
    return find_scene_key(pattern_.empty() ? key : pattern_ + "." + key);
  }
  const SceneKey& row(const std::string& key) const { return *find_row(key); }
  Section section(const std::string& key) const { return {node(key), row(key).path}; }

  // The value of a key by one of the functions above: get(number_value, "mass").
  template <class Value>
  Value get(Value (*read)(const YamlNode&, const SceneKey&), const std::string& key) const {
    return read(node(key), row(key));
  }
  template <class Value>
  Value get_or(Value (*read)(const YamlNode&, const SceneKey&), const std::string& key,
               const Value& fallback) const {
    return has(key) ? read(node(key), row(key)) : fallback;
  }

 private:
  const YamlNode& map_;
  std::string pattern_;
};

}  // namespace fc

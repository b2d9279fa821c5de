#include "common/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/scene_keys.hpp"
#include "common/scene_values.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

constexpr std::string_view kUnless = "required unless ";

class KeyChecker {
 public:
  KeyChecker(const YamlNode& scene, int chapter) : scene_(scene), chapter_(chapter) {}

  std::map<std::string, SourceMark> marks;

  // A map whose keys the table lists below `pattern`; `path` is where this map is in the scene.
  void check_section(const YamlNode& map, const std::string& pattern, const std::string& path) {
    for (const YamlNode::Entry& entry : map.entries) {
      const SceneKey* key = find_scene_key(pattern.empty() ? entry.key : pattern + "." + entry.key);
      const LaterName* later = find_later_name(entry.key);
      const std::string name = in_quotes(entry.key);
      if (later) refuse(entry.key_place, fmt::format("{} {}; remove it", name, later->text()));
      if (!key) refuse_unknown(entry, pattern, path);
      if (chapter_ < key->first) {
        refuse(entry.key_place, fmt::format("{} comes with {}; remove it, or run the scene with that chapter",
                                            name, chapter_title(key->first)));
      }
      if (!key->known_in(chapter_)) {
        refuse(entry.key_place, fmt::format("{} has no effect in {}, only in {}; remove it", name,
                                            chapter_title(chapter_), key->chapters_text()));
      }
      if (!key->idle_beside.empty() && scene_.find(key->idle_beside)) {
        refuse(entry.key_place,
               fmt::format("{} has no effect beside {}; remove it", name, in_quotes(key->idle_beside)));
      }
      const std::string key_path = path.empty() ? entry.key : path + "." + entry.key;
      marks[key_path] = entry.key_place.mark();
      check_node(*entry.value, *key, key_path);
    }
    check_required(map, pattern, path);
  }

 private:
  void check_node(const YamlNode& node, const SceneKey& key, const std::string& path) {
    switch (key.type) {
      case KeyType::section:
        check_map(node, key, key.path, path, "a section");
        return;
      case KeyType::named:
        if (node.kind != YamlNode::Kind::map || node.entries.empty()) {
          refuse_type(node, key, "a map with at least one name");
        }
        for (const YamlNode::Entry& entry : node.entries) {
          marks[path + "." + entry.key] = entry.key_place.mark();
          check_map(*entry.value, key, key.path + ".<name>", path + "." + entry.key,
                    "a map of names to sections");
        }
        return;
      case KeyType::list:
        if (node.kind != YamlNode::Kind::list || node.items.empty()) {
          refuse_type(node, key, "a list of at least one section");
        }
        for (std::size_t i = 0; i < node.items.size(); ++i) {
          check_map(*node.items[i], key, key.path + "[]", path + "." + std::to_string(i),
                    "a list of sections");
        }
        return;
      case KeyType::choice:
        check_choice(node, key);
        return;
      default:
        check_value(node, key);
        return;
    }
  }

  void check_map(const YamlNode& node, const SceneKey& key, const std::string& pattern,
                 const std::string& path, const std::string& expected) {
    if (node.kind != YamlNode::Kind::map) refuse_type(node, key, expected);
    check_section(node, pattern, path);
  }

  void check_choice(const YamlNode& node, const SceneKey& key) const {
    const std::string word = text_value(node, key);
    if (std::find(key.choices.begin(), key.choices.end(), word) != key.choices.end()) return;
    if (const LaterName* later = find_later_name(key.path + ": " + word)) {
      refuse(node.place, fmt::format("{} {}; write {}", in_quotes(word), later->text(), one_of(key.choices)));
    }
    refuse(node.place,
           fmt::format("{} is not a {}; write {}", in_quotes(word), key.last_name(), one_of(key.choices)));
  }

  void check_required(const YamlNode& map, const std::string& pattern, const std::string& path) const {
    for (const std::string& name : scene_keys_below(pattern, chapter_)) {
      const SceneKey& key = *find_scene_key(pattern.empty() ? name : pattern + "." + name);
      const bool needed = key.fallback == "required" || (key.fallback.starts_with(kUnless) &&
                                                         !map.find(key.fallback.substr(kUnless.size())));
      if (!needed || map.find(name)) continue;
      refuse(map.place, fmt::format("missing key {}{}; add e.g. {}: {}", in_quotes(name),
                                    path.empty() ? "" : " in " + in_quotes(path), name, key.example));
    }
  }

  [[noreturn]] void refuse_unknown(const YamlNode::Entry& entry, const std::string& pattern,
                                   const std::string& path) const {
    refuse(entry.key_place,
           fmt::format("unknown key {}{}; the nearest known key is {}", in_quotes(entry.key),
                       path.empty() ? "" : " in " + in_quotes(path), nearest_key(entry.key, pattern)));
  }

  // A key from elsewhere in the table, if the name matches it exactly; else the nearest key that may stand
  // here, those of other chapters included.
  std::string nearest_key(const std::string& name, const std::string& pattern) const {
    for (const SceneKey& key : scene_keys())
      if (key.last_name() == name && key.known_in(chapter_))
        return in_quotes(key.path) + (key.path == name ? " at the top" : "");
    std::vector<std::string> names = scene_keys_below(pattern);
    for (const LaterName& later : later_names()) names.push_back(later.name);
    const std::string best = nearest(name, names);
    if (const LaterName* later = find_later_name(best)) return in_quotes(best) + ", which " + later->text();
    const SceneKey& key = *find_scene_key(pattern.empty() ? best : pattern + "." + best);
    return in_quotes(best) + (key.known_in(chapter_) ? "" : ", which is for " + key.chapters_text());
  }

  const YamlNode& scene_;
  int chapter_;
};

}  // namespace

std::map<std::string, SourceMark> check_scene_keys(const YamlNode& scene, int chapter) {
  KeyChecker checker(scene, chapter);
  checker.check_section(scene, "", "");
  return std::move(checker.marks);
}

}  // namespace fc

// A YAML document as a plain tree in which every node knows its line and column.
//
// yaml-cpp's own tree accepts duplicate keys and forgets which scalars were quoted; its parser's events do
// not, so the tree is built from them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/errors.hpp"

namespace fc {

struct YamlNode;
using YamlPtr = std::shared_ptr<const YamlNode>;  // aliases share nodes, which never change

// The file, or the option, that nodes came from; shared by all of them.
using YamlOrigin = std::shared_ptr<const std::string>;

struct YamlPlace {
  YamlOrigin origin;
  int line = 0, column = 0;  // 1-based; 0 = from an option

  SourceMark mark() const { return {origin ? *origin : "", line, column}; }
};

struct YamlNode {
  enum class Kind { nothing, text, list, map };
  struct Entry {
    std::string key;
    YamlPlace key_place;
    YamlPtr value;
  };

  Kind kind = Kind::nothing;
  YamlPlace place;
  std::string text;            // Kind::text
  bool is_quoted = false;      // Kind::text: in quotes, or a block
  std::vector<YamlPtr> items;  // Kind::list
  std::vector<Entry> entries;  // Kind::map, in file order; no key twice
  int height = 0;              // levels below this node

  SourceMark mark() const { return place.mark(); }
  // The entry of a map with this key, or nullptr.
  const Entry* find(std::string_view key) const;
};

// Throws InputError at the node.
[[noreturn]] void refuse(const YamlPlace& place, const std::string& message);

// Reads a whole text file, with \n for every line end and no byte order mark; refuses a missing, empty, binary or
// oversized one, and a folder.
std::string read_text_file(const std::filesystem::path& file);

// Parses one document. Refuses wrong syntax, a key given twice, tags, and nesting beyond any scene's need. An
// option's value keeps no lines and columns.
YamlPtr parse_yaml(const std::string& text, const YamlOrigin& origin, bool is_option_value = false);

// The tree with the value at `path` ("bodies.0.velocity") replaced, or added to a map. Keys that contain dots
// are found when they exist. `origin` names the option in messages, and is the place of keys that are added.
YamlPtr with_value(const YamlPtr& root, std::string_view path, const YamlPtr& value,
                   const YamlOrigin& origin);

// The tree without the key at `path`, which leads through maps; the tree itself if it has no such key.
YamlPtr without_key(const YamlPtr& root, std::string_view path);

}  // namespace fc

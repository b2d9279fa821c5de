// Reading scene files as text, and changing one value of a tree (--set).
#include <algorithm>
#include <charconv>

#include "common/input_file.hpp"
#include "common/text.hpp"
#include "common/yaml_tree.hpp"

namespace fc {
namespace {

constexpr std::size_t largest_file = 64 << 20;  // bytes; a hull of a million points fits

// The offset of the first byte that no UTF-8 text has (a control character, or a broken sequence); npos if
// none.
std::size_t first_binary_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool is_control = byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r';
    if (is_control || byte == 0x7f) return i;
    std::size_t length = 1;
    if (byte >= 0xC2 && byte <= 0xDF) length = 2;
    if (byte >= 0xE0 && byte <= 0xEF) length = 3;
    if (byte >= 0xF0 && byte <= 0xF4) length = 4;
    if ((byte >= 0x80 && length == 1) || i + length > text.size()) return i;
    for (std::size_t k = 1; k < length; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return i;
    }
    i += length;
  }
  return std::string_view::npos;
}

// The key of `map` that `path` begins with: the longest existing one, else the text up to the first dot.
std::string_view first_key(const YamlNode& map, std::string_view path) {
  std::string_view best;
  for (const YamlNode::Entry& entry : map.entries) {
    const bool begins =
        path.starts_with(entry.key) && (path.size() == entry.key.size() || path[entry.key.size()] == '.');
    if (begins && entry.key.size() > best.size()) best = path.substr(0, entry.key.size());
  }
  return best.empty() ? path.substr(0, path.find('.')) : best;
}

std::string_view rest_after(std::string_view path, std::size_t used) {
  return used < path.size() ? path.substr(used + 1) : std::string_view();
}

YamlPtr with_item(const YamlNode& list, std::string_view path, const YamlPtr& value,
                  const YamlOrigin& origin) {
  const std::string_view segment = path.substr(0, path.find('.'));
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(segment.data(), segment.data() + segment.size(), index);
  const bool is_index = error == std::errc() && end == segment.data() + segment.size();
  if (!is_index || index >= list.items.size()) {
    refuse({origin}, in_quotes(segment) + " is not an item of a list of " +
                         std::to_string(list.items.size()) + "; count its items from 0");
  }
  auto changed = std::make_shared<YamlNode>(list);
  changed->items[index] = with_value(list.items[index], rest_after(path, segment.size()), value, origin);
  return changed;
}

YamlPtr with_entry(const YamlNode& map, std::string_view path, const YamlPtr& value,
                   const YamlOrigin& origin) {
  const std::string_view key = first_key(map, path);
  if (key.empty()) refuse({origin}, "an empty name in the key's path; write it as e.g. ccd.tolerance");
  auto changed = std::make_shared<YamlNode>(map);
  for (YamlNode::Entry& entry : changed->entries) {
    if (entry.key != key) continue;
    entry.value = with_value(entry.value, rest_after(path, key.size()), value, origin);
    return changed;
  }
  auto section = std::make_shared<YamlNode>();  // a key that the file leaves out
  section->kind = YamlNode::Kind::map;
  section->place = {origin};
  YamlNode::Entry added;
  added.key = key;
  added.key_place = {origin};
  added.value = with_value(section, rest_after(path, key.size()), value, origin);
  changed->entries.push_back(added);
  return changed;
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file) {
  InputFile input = read_input_file(file, "a scene", largest_file);
  refuse_other_kind(input, "a scene");
  std::string& text = input.bytes;
  unify_text(text);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError({file.string(), 1, 1}, "the file is empty; write a scene into it");
  }
  const std::size_t binary = first_binary_byte(text);
  if (binary != std::string::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(binary), '\n');
    const std::size_t line_start = text.rfind('\n', binary) + 1;  // npos + 1 = 0
    throw InputError({file.string(), static_cast<int>(line), static_cast<int>(binary - line_start) + 1},
                     "not text but binary data; a scene is YAML in UTF-8");
  }
  return std::move(text);
}

YamlPtr with_value(const YamlPtr& root, std::string_view path, const YamlPtr& value,
                   const YamlOrigin& origin) {
  if (path.empty()) return value;
  switch (root->kind) {
    case YamlNode::Kind::list:
      return with_item(*root, path, value, origin);
    case YamlNode::Kind::map:
      return with_entry(*root, path, value, origin);
    case YamlNode::Kind::nothing: {
      YamlNode map;
      map.kind = YamlNode::Kind::map;
      map.place = root->place;
      return with_entry(map, path, value, origin);
    }
    case YamlNode::Kind::text:
      break;
  }
  refuse({origin}, in_quotes(path) + " would be inside the single value " + in_quotes(root->text) +
                       "; set the whole value instead");
}

YamlPtr without_key(const YamlPtr& root, std::string_view path) {
  if (root->kind != YamlNode::Kind::map) return root;
  const std::string_view key = first_key(*root, path), rest = rest_after(path, key.size());
  auto changed = std::make_shared<YamlNode>(*root);
  if (rest.empty()) {
    std::erase_if(changed->entries, [&](const YamlNode::Entry& entry) { return entry.key == key; });
    return changed;
  }
  for (YamlNode::Entry& entry : changed->entries)
    if (entry.key == key) entry.value = without_key(entry.value, rest);
  return changed;
}

}  // namespace fc

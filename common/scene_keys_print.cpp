// The table of scene keys as text: in messages, in --help, and as a page.
#include <fmt/format.h>

#include "common/scene_keys.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

// "number [m] in (0, 1000]", "directional or naive".
std::string value_text(const SceneKey& key) {
  if (key.type == KeyType::choice) return one_of(key.choices);
  std::string text = key.type_text();
  if (!key.unit.empty() && key.unit != "1") text += " [" + key.unit + "]";
  const std::string range = key.range.text();
  if (!range.empty()) text += " in " + range;
  return text;
}

// A cell of a Markdown table: '|' and '<' would be read as markup.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|')
      escaped += "\\|";
    else if (c == '<')
      escaped += "&lt;";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace

std::string Range::text() const {
  if (low == -std::numeric_limits<double>::infinity()) return "";
  return fmt::format("{}{:g}, {:g}]", excludes_low ? "(" : "[", low, high);
}

std::string SceneKey::type_text() const {
  switch (type) {
    case KeyType::text:
      return "text";
    case KeyType::file:
      return "file";
    case KeyType::choice:
      return "one of " + one_of(choices);
    case KeyType::boolean:
      return "true or false";
    case KeyType::integer:
      return "integer";
    case KeyType::number:
      return "number";
    case KeyType::vector3:
      return "[x, y, z]";
    case KeyType::integers3:
      return "[nx, ny, nz]";
    case KeyType::quaternion:
      return "[w, x, y, z]";
    case KeyType::inertia:
      return "[Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz]";
    case KeyType::body:
      return "number or name of a body";
    case KeyType::words:
      return "list of " + one_of(choices, ", ");
    case KeyType::points:
      return "list of [x, y, z]";
    case KeyType::numbers:
      return "list of numbers";
    case KeyType::matrix:
      return "list of rows";
    case KeyType::section:
      return "section";
    case KeyType::named:
      return "named sections";
    case KeyType::list:
      return "list of sections";
  }
  return "";
}

std::string chapters_text(int first, int last) {
  if (last == all_later_chapters) return first == 1 ? "all chapters" : fmt::format("chapter {} on", first);
  if (first == last) return fmt::format("chapter {}", first);
  return fmt::format("chapters {} {} {}", first, last == first + 1 ? "and" : "to", last);
}

std::string SceneKey::chapters_text() const {
  if (except == 0) return fc::chapters_text(first, last);
  return fc::chapters_text(first, except - 1) + " and " + fc::chapters_text(except + 1, last);
}

std::string SceneKey::meaning_text() const {
  return meaning + (idle_beside.empty() ? "" : " Not beside " + idle_beside + ".");
}

std::string LaterName::text() const {
  if (!complete_form) return "comes with " + chapter_title(chapter);
  return fmt::format("comes with the complete chapter {}, which this version does not have yet", chapter);
}

std::string scene_keys_help(int chapter) {
  std::string text =
      "Scene keys that this chapter knows (YAML; SI units, z up; <name> is any shape's name, [] any list "
      "item):\n";
  std::size_t width = 0;
  for (const SceneKey& key : scene_keys()) {
    if (key.known_in(chapter)) width = std::max(width, key.path.size());
  }
  for (const SceneKey& key : scene_keys()) {
    if (!key.known_in(chapter)) continue;
    const std::string needed =
        key.fallback.starts_with("required") ? key.fallback : "default: " + key.fallback;
    text += fmt::format("  {}  {} ({})\n", padded(key.path, width), value_text(key), needed);
    text += fmt::format("  {}  {} Example: {}: {}\n", padded("", width), key.meaning_text(), key.last_name(),
                        key.example);
  }
  return text;
}

std::string scene_keys_markdown() {
  std::string text =
      "# Scene keys\n\n"
      "Every key that a scene can have: the table that checks scenes and prints as `--help`, written out by "
      "its test.\n"
      "YAML, SI units, z up. `<name>` stands for any shape's name, `[]` for any item of a list.\n\n"
      "| key | known to | required, or default | type | unit | range | meaning | example |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const SceneKey& key : scene_keys()) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | `{}` |\n", key.path, key.chapters_text(),
                        cell(key.fallback), cell(key.type_text()), key.unit, cell(key.range.text()),
                        cell(key.meaning_text()), key.example);
  }
  text += "\nNames that are refused until they exist:\n\n| name | |\n| --- | --- |\n";
  for (const LaterName& later : later_names())
    text += fmt::format("| `{}` | {} |\n", later.name, later.text());
  return text;
}

}  // namespace fc

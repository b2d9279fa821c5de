// The one table of scene keys: it checks every scene, prints in --help, and is the page SCENE_KEYS.md.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace fc {

enum class KeyType {
  text,
  file,    // a path, relative to the scene's folder or absolute
  choice,  // one word of SceneKey::choices
  boolean,
  integer,
  number,
  vector3,     // [x, y, z]
  integers3,   // [nx, ny, nz]
  quaternion,  // [w, x, y, z], not zero
  inertia,     // [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz]
  body,        // the number of a body, or its name
  words,       // a list of words of SceneKey::choices, none twice
  points,      // a list of [x, y, z]
  numbers,     // a list of numbers
  matrix,      // a list of rows, each a list of as many numbers
  section,     // a map of the keys below it in the table
  named,       // a map of the scene's own names to sections
  list,        // a list of sections
};

// What a number may be; the same for every component of a vector.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool excludes_low = false;

  bool contains(double x) const { return (excludes_low ? x > low : x >= low) && x <= high; }
  std::string text() const;  // "(0, 1000]"; empty if there are no limits
};

inline constexpr int all_later_chapters = 99;

struct SceneKey {
  std::string path;  // "ccd.tolerance"; "shapes.<name>.mass" of every shape; "bodies[].spin" of every body
  int first = 1;     // the chapters that know it
  int last = all_later_chapters;
  // "required" or "required unless KEY" (of the same section), both checked; or when it is required, in words; or the default.
  std::string fallback;
  KeyType type = KeyType::section;
  std::string unit;
  Range range;
  std::string meaning;  // one sentence
  std::string example;  // a value, as written in a scene
  std::vector<std::string> choices;
  int except = 0;                // a chapter between first and last in which it would have no effect
  std::string idle_beside = {};  // a top-level key beside which it would have none either, or ""

  std::string last_name() const { return path.substr(path.rfind('.') + 1); }
  bool known_in(int chapter) const { return first <= chapter && chapter <= last && chapter != except; }
  std::string type_text() const;      // "number", "[x, y, z]", ...
  std::string chapters_text() const;  // "chapters 1 and 2 and chapter 4 on"
  std::string meaning_text() const;   // the meaning, and the key beside which it has no effect
};

// A key, or a value of one, that comes with a later chapter, or with a chapter's complete form.
struct LaterName {
  std::string name;  // "friction", "solver.method: lemke"
  int chapter = 0;
  bool complete_form = false;  // the chapter exists, but does not have it yet

  std::string text() const;  // "comes with chapter 6 (friction)"
};

const std::vector<SceneKey>& scene_keys();
const std::vector<LaterName>& later_names();

// "chapter 3", "chapters 1 and 2", "chapter 4 on", "all chapters".
std::string chapters_text(int first, int last);

// The row of the table with this path, or nullptr.
const SceneKey* find_scene_key(const std::string& path);

// The keys directly below a path ("" = the top) that a chapter knows, or any (0), by their last names.
std::vector<std::string> scene_keys_below(const std::string& parent, int chapter = 0);

// The later name, or nullptr.
const LaterName* find_later_name(const std::string& name);

// "chapter 4 (multibody stepping)".
std::string chapter_title(int chapter);

// The keys that a chapter knows, for --help.
std::string scene_keys_help(int chapter);

// The whole table as a Markdown page.
std::string scene_keys_markdown();

}  // namespace fc

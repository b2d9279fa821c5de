#include "common/scene_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/number_text.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

bool is_boolean_word(const std::string& text) {
  static const std::vector<std::string> words = {"true", "True", "TRUE", "false", "False", "FALSE"};
  return std::find(words.begin(), words.end(), text) != words.end();
}

// What a value is, in words: "the text 'abc'", "a list of length 2", "nothing".
std::string description(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::nothing:
      return "nothing";
    case YamlNode::Kind::list:
      return fmt::format("a list of length {}", node.items.size());
    case YamlNode::Kind::map:
      return node.entries.empty() ? "an empty map" : "a map of keys";
    case YamlNode::Kind::text:
      break;
  }
  if (node.is_quoted) return "the quoted text " + in_quotes(node.text);
  if (is_boolean_word(node.text)) return "the boolean " + node.text;
  double ignored = 0;
  if (read_number(node.text, ignored) != NumberText::not_a_number) {
    return "the number " + one_line(node.text.substr(0, 60));
  }
  const std::size_t first = node.text.find_first_not_of("+-.");
  if (first != std::string::npos && node.text[first] >= '0' && node.text[first] <= '9') {
    return in_quotes(node.text) + ", which is not a plain decimal number";  // 010, 0x10, 1_000, 0,5
  }
  return "the text " + in_quotes(node.text);
}

// A shorter vector has too few digits left to be certain of a direction.
constexpr double shortest_direction = 1e-9;

bool is_plain_number(const YamlNode& node) {
  double ignored = 0;
  return node.kind == YamlNode::Kind::text && !node.is_quoted &&
         read_number(node.text, ignored) != NumberText::not_a_number;
}

std::string with_unit(const std::string& what, const SceneKey& key) {
  return key.unit.empty() || key.unit == "1" ? what : what + " in " + key.unit;
}

[[noreturn]] void refuse_range(const YamlNode& node, const SceneKey& key, const std::string& problem) {
  refuse(node.place, fmt::format("{} is {}{}; write e.g. {}: {}", in_quotes(key.last_name()),
                                 one_line(node.text.substr(0, 60)), problem, key.last_name(), key.example));
}

// A component of the key's value, or the value itself.
double number_in(const YamlNode& node, const SceneKey& key, const std::string& expected) {
  if (node.kind != YamlNode::Kind::text || node.is_quoted) refuse_type(node, key, expected);
  double value = 0;
  switch (read_number(node.text, value)) {
    case NumberText::finite:
      break;
    case NumberText::not_finite:
      refuse_range(node, key, ", not a finite number");
    case NumberText::too_large:
      refuse_range(node, key, ", beyond what a double can hold");
    case NumberText::not_a_number:
      refuse_type(node, key, expected);
  }
  if (!key.range.contains(value)) refuse_range(node, key, ", out of range " + key.range.text());
  return value;
}

int integer_in(const YamlNode& node, const SceneKey& key, const std::string& expected) {
  const double value = number_in(node, key, expected);
  if (node.text.find_first_of(".eE") != std::string::npos) refuse_type(node, key, expected);
  return static_cast<int>(value);  // every integer key's range fits
}

// The items of a list of the given length.
const std::vector<YamlPtr>& items_of(const YamlNode& node, const SceneKey& key, std::size_t length,
                                     const std::string& expected) {
  if (node.kind != YamlNode::Kind::list || node.items.size() != length) refuse_type(node, key, expected);
  return node.items;
}

Vec3 vector_in(const YamlNode& node, const SceneKey& key, const std::string& expected) {
  const auto& items = items_of(node, key, 3, expected);
  Vec3 value;
  for (std::size_t i = 0; i < 3; ++i) value[static_cast<int>(i)] = number_in(*items[i], key, "three numbers");
  return value;
}

VecX numbers_in(const std::vector<YamlPtr>& items, const SceneKey& key, const std::string& expected) {
  VecX values(static_cast<Eigen::Index>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = number_in(*items[i], key, expected);
  }
  return values;
}

}  // namespace

void refuse_type(const YamlNode& node, const SceneKey& key, const std::string& expected) {
  refuse(node.place, fmt::format("{} must be {}, found {}; write e.g. {}: {}", in_quotes(key.last_name()),
                                 with_unit(expected, key), description(node), key.last_name(), key.example));
}

std::string text_value(const YamlNode& node, const SceneKey& key) {
  if (node.kind != YamlNode::Kind::text || node.text.empty()) refuse_type(node, key, "text");
  return node.text;
}

bool boolean_value(const YamlNode& node, const SceneKey& key) {
  const bool is_plain = node.kind == YamlNode::Kind::text && !node.is_quoted;
  if (!is_plain || !is_boolean_word(node.text)) refuse_type(node, key, "true or false");
  return node.text[0] == 't' || node.text[0] == 'T';
}

int integer_value(const YamlNode& node, const SceneKey& key) {
  return integer_in(node, key, "an integer");
}

double number_value(const YamlNode& node, const SceneKey& key) {
  return number_in(node, key, "a number");
}

Vec3 vector_value(const YamlNode& node, const SceneKey& key) {
  return vector_in(node, key, "[x, y, z]");
}

std::array<int, 3> integers_value(const YamlNode& node, const SceneKey& key) {
  const auto& items = items_of(node, key, 3, "three integers");
  std::array<int, 3> value{};
  for (std::size_t i = 0; i < 3; ++i) value[i] = integer_in(*items[i], key, "three integers");
  return value;
}

Quat quaternion_value(const YamlNode& node, const SceneKey& key) {
  const auto& items = items_of(node, key, 4, "[w, x, y, z]");
  Eigen::Vector4d wxyz;
  for (std::size_t i = 0; i < 4; ++i) wxyz[static_cast<int>(i)] = number_in(*items[i], key, "four numbers");
  const double length = wxyz.stableNorm();
  if (length < shortest_direction) {
    refuse(node.place,
           in_quotes(key.last_name()) + " is zero; write a quaternion [w, x, y, z], e.g. [1, 0, 0, 0]");
  }
  if (length != 1) wxyz /= length;
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

Vec3 direction_value(const YamlNode& node, const SceneKey& key) {
  const Vec3 value = vector_value(node, key);
  if (value.stableNorm() < shortest_direction)
    refuse(node.place, fmt::format("{} is zero; write a direction, e.g. {}: {}", in_quotes(key.last_name()),
                                   key.last_name(), key.example));
  return value.stableNormalized();
}

int body_value(const YamlNode& node, const SceneKey& key, const std::vector<std::string>& names) {
  check_value(node, key);
  if (is_plain_number(node)) {
    const int number = integer_value(node, key);
    if (static_cast<std::size_t>(number) < names.size()) return number;
    refuse(node.place,
           fmt::format("there is no body {}; the bodies are numbered 0 to {}", number, names.size() - 1));
  }
  const auto found = std::find(names.begin(), names.end(), node.text);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  std::vector<std::string> given;
  std::copy_if(names.begin(), names.end(), std::back_inserter(given),
               [](const std::string& name) { return !name.empty(); });
  refuse(node.place,
         fmt::format("no body is named {}; {}", in_quotes(node.text),
                     given.empty() ? "no body here has a name: write its number, or give it a name"
                                   : "the nearest name is " + in_quotes(nearest(node.text, given))));
}

std::vector<std::string> words_value(const YamlNode& node, const SceneKey& key) {
  if (node.kind != YamlNode::Kind::list || node.items.empty()) refuse_type(node, key, "a list of words");
  std::vector<std::string> words;
  for (const YamlPtr& item : node.items) {
    const std::string word = text_value(*item, key);
    if (std::find(key.choices.begin(), key.choices.end(), word) == key.choices.end())
      refuse(item->place, fmt::format("{} is none of {}; write e.g. {}: {}", in_quotes(word),
                                      one_of(key.choices, ", "), key.last_name(), key.example));
    if (std::find(words.begin(), words.end(), word) != words.end())
      refuse(item->place, fmt::format("{} is given twice; keep one of them", in_quotes(word)));
    words.push_back(word);
  }
  return words;
}

Mat3 inertia_value(const YamlNode& node, const SceneKey& key) {
  const bool is_diagonal = node.items.size() == 3;
  const auto& items = items_of(node, key, is_diagonal ? 3 : 6, key.type_text());
  std::array<double, 6> i{};
  for (std::size_t k = 0; k < items.size(); ++k) i[k] = number_in(*items[k], key, "three or six numbers");
  Mat3 inertia;
  inertia << i[0], i[3], i[4],  //
      i[3], i[1], i[5],         //
      i[4], i[5], i[2];
  return inertia;
}

std::vector<Vec3> points_value(const YamlNode& node, const SceneKey& key) {
  if (node.kind != YamlNode::Kind::list || node.items.empty())
    refuse_type(node, key, "a list of points [x, y, z]");
  std::vector<Vec3> points;
  for (const YamlPtr& item : node.items)
    points.push_back(vector_in(*item, key, "a list of points [x, y, z]"));
  return points;
}

VecX numbers_value(const YamlNode& node, const SceneKey& key) {
  if (node.kind != YamlNode::Kind::list || node.items.empty()) refuse_type(node, key, "a list of numbers");
  return numbers_in(node.items, key, "a list of numbers");
}

MatX matrix_value(const YamlNode& node, const SceneKey& key) {
  constexpr std::size_t largest = 5000;  // 200 MB
  const std::size_t n = node.items.size();
  if (node.kind != YamlNode::Kind::list || n == 0) refuse_type(node, key, "a list of rows");
  if (n > largest) refuse(node.place, fmt::format("{} rows are too many; use matrix and vector files", n));
  MatX matrix(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    const YamlNode& row = *node.items[i];
    const std::string expected = fmt::format("square, with {} numbers in each of its {} rows", n, n);
    matrix.row(static_cast<Eigen::Index>(i)) =
        numbers_in(items_of(row, key, n, expected), key, expected).transpose();
  }
  return matrix;
}

void check_value(const YamlNode& node, const SceneKey& key) {
  switch (key.type) {
    case KeyType::text:
    case KeyType::file:
    case KeyType::choice:
      text_value(node, key);
      return;
    case KeyType::boolean:
      boolean_value(node, key);
      return;
    case KeyType::integer:
      integer_value(node, key);
      return;
    case KeyType::number:
      number_value(node, key);
      return;
    case KeyType::vector3:
      vector_value(node, key);
      return;
    case KeyType::integers3:
      integers_value(node, key);
      return;
    case KeyType::quaternion:
      quaternion_value(node, key);
      return;
    case KeyType::body:
      is_plain_number(node) ? void(integer_value(node, key)) : void(text_value(node, key));
      return;
    case KeyType::words:
      words_value(node, key);
      return;
    case KeyType::inertia:
      inertia_value(node, key);
      return;
    case KeyType::points:
      points_value(node, key);
      return;
    case KeyType::numbers:
      numbers_value(node, key);
      return;
    case KeyType::matrix:
      matrix_value(node, key);
      return;
    case KeyType::section:
    case KeyType::named:
    case KeyType::list:
      return;  // their keys are checked one by one
  }
}

}  // namespace fc

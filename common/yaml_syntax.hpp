// The first pass over a YAML text: whether its syntax is valid.
#pragma once

#include <string>

#include "common/yaml_tree.hpp"

namespace fc {

// A scene nests about 6 deep. The limit keeps recursion over a tree, and a chain of aliases, off the end of
// the stack.
inline constexpr int deepest_yaml = 64;

// The text as both passes read it: with a comment added at its end, which reveals a quote that never ends.
std::string with_end_comment(const std::string& text);

// Refuses wrong syntax, a quote that never ends, a second document, and nesting beyond the limit. Messages
// about an option's value name no line.
void check_yaml_syntax(const std::string& text, const YamlOrigin& origin, bool is_option_value);

}  // namespace fc

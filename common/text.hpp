// Small helpers for messages and file names.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fc {

// The text with every control character and invisible blank written as \xNN, so that a message stays one line
// whatever it quotes.
std::string one_line(std::string_view text);

// 'text' in quotes for a message, on one line and shortened when long.
std::string in_quotes(std::string_view text);

// How many single-character insertions, deletions, replacements and swaps of neighbours turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate nearest to `name` by edit distance, the first of equals; empty if there is none.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

// "1, 2 or 3".
std::string one_of(const std::vector<std::string>& words, std::string_view last_separator = " or ");

// A name for a file or folder: letters, digits, '.', '_', '-', '=' and everything beyond ASCII stay, all else
// becomes '_'; never empty, never hidden, never longer than most file systems allow.
std::string file_name_from(std::string_view text);

// Pads with spaces up to `width` characters (UTF-8 code points).
std::string padded(std::string_view text, std::size_t width);

}  // namespace fc

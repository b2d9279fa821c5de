#include "common/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace fc {

std::string one_line(std::string_view text) {
  // A byte order mark, a no-break space, a zero-width space: invisible in a message.
  constexpr std::array<std::string_view, 3> unseen = {"\xEF\xBB\xBF", "\xC2\xA0", "\xE2\x80\x8B"};
  std::string line;
  std::size_t unseen_end = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    for (std::string_view u : unseen) {
      if (text.substr(i).starts_with(u)) unseen_end = i + u.size();
    }
    if (byte < 0x20 || byte == 0x7f || i < unseen_end) {
      line += fmt::format("\\x{:02x}", byte);
    } else {
      line += text[i];
    }
  }
  return line;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return fmt::format("'{}'", one_line(text));
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
    --end;  // not inside a UTF-8 character
  return fmt::format("'{}...'", one_line(text.substr(0, end)));
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Row i of the table of distances between prefixes, from the two rows before it.
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swap) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  name = name.substr(0, 100);  // more characters cannot make a candidate nearer, only slower
  const auto by_distance = [&](const std::string& a, const std::string& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  };
  const auto best = std::min_element(candidates.begin(), candidates.end(), by_distance);
  return best == candidates.end() ? "" : *best;
}

std::string one_of(const std::vector<std::string>& words, std::string_view last_separator) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? std::string(last_separator) : ", ";
    text += words[i];
  }
  return text;
}

std::string file_name_from(std::string_view text) {
  constexpr std::size_t longest = 100;
  std::string name;
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || byte >= 0x80;
    name += plain || c == '.' || c == '_' || c == '-' || c == '=' ? c : '_';
  }
  if (name.empty()) return "_";
  if (name[0] == '.') name[0] = '_';
  return name;
}

std::string padded(std::string_view text, std::size_t width) {
  const auto begins_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  const auto length = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
  return std::string(text) + std::string(width > length ? width - length : 0, ' ');
}

}  // namespace fc

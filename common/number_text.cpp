#include "common/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace fc {
namespace {

// Removes the digits that the text begins with and returns how many they were.
std::size_t skip_digits(std::string_view& text) {
  const std::size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(count);
  return count;
}

void skip_sign(std::string_view& text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
}

bool names_infinity_or_nan(std::string_view unsigned_text) {
  std::string lower(unsigned_text.substr(0, 10));
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return lower == ".inf" || lower == ".nan" || lower == "inf" || lower == "nan" || lower == "infinity";
}

bool is_decimal(std::string_view unsigned_text) {
  std::string_view rest = unsigned_text;
  const std::size_t before_point = skip_digits(rest);
  const bool may_be_octal = before_point > 1 && unsigned_text[0] == '0';
  std::size_t after_point = 0;
  if (rest.starts_with('.')) {
    rest.remove_prefix(1);
    after_point = skip_digits(rest);
  }
  if (before_point + after_point == 0) return false;
  if (rest.starts_with('e') || rest.starts_with('E')) {
    rest.remove_prefix(1);
    skip_sign(rest);
    if (skip_digits(rest) == 0) return false;
  }
  return rest.empty() && !(may_be_octal && before_point == unsigned_text.size());
}

}  // namespace

NumberText read_number(std::string_view text, double& value) {
  std::string_view unsigned_text = text;
  skip_sign(unsigned_text);
  if (names_infinity_or_nan(unsigned_text)) return NumberText::not_finite;
  if (!is_decimal(unsigned_text)) return NumberText::not_a_number;
  if (text[0] == '+') text.remove_prefix(1);  // from_chars takes no plus
  double read = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (error != std::errc() || !std::isfinite(read)) return NumberText::too_large;
  value = read;
  return NumberText::finite;
}

bool read_c_number(std::string_view text, double& value) {
  const std::string_view whole = text;
  const bool minus = text.starts_with('-');
  skip_sign(text);
  if (text.empty() || text[0] == '-' || text[0] == '+') return false;
  auto format = std::chars_format::general;
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
    format = std::chars_format::hex;
    text.remove_prefix(2);
    if (text.find_first_of("0123456789abcdefABCDEF.") != 0) return false;
  }
  double read = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read, format);
  if (error == std::errc::invalid_argument || end != text.data() + text.size()) return false;
  if (error == std::errc::result_out_of_range) {
    value = std::strtod(std::string(whole).c_str(), nullptr);  // 0 or infinity
  } else {
    value = minus ? -read : read;
  }
  return true;
}

std::errc read_whole_number(std::string_view text, long long& value) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::errc::invalid_argument;
  }
  long long read = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (error == std::errc::invalid_argument || end != text.data() + text.size())
    return std::errc::invalid_argument;
  if (error == std::errc()) value = read;
  return error;
}

}  // namespace fc

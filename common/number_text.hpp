// Decimal numbers, read strictly.
#pragma once

#include <ostream>
#include <string_view>

namespace fc {

enum class NumberText {
  finite,
  not_finite,    // .inf, .nan and their other spellings
  too_large,     // a decimal number that no double can hold, or so small that it would vanish
  not_a_number,  // anything else, such as 010 (eight or ten?), 0x10, 1_000, 0,5
};
inline std::ostream& operator<<(std::ostream& out, NumberText text) {
  constexpr const char* kNames[] = {"finite", "not_finite", "too_large", "not_a_number"};
  return out << kNames[static_cast<int>(text)];
}

// Reads [sign] digits [. digits] [e [sign] digits] without leading zeros; sets `value` only if the result is
// `finite`.
NumberText read_number(std::string_view text, double& value);

}  // namespace fc

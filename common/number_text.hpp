// Numbers in texts: those of scenes, which are read strictly, and those of data files, which are read as C
// reads them.
#pragma once

#include <ostream>
#include <string_view>
#include <system_error>

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

// A number of a scene: [sign] digits [. digits] [e [sign] digits]. A whole number has no leading zeros. Sets
// `value` only if the result is `finite`.
NumberText read_number(std::string_view text, double& value);

// A number of a data file (mesh, table, matrix): the whole text in any form that strtod reads in the C
// locale, so +3.0E+00, .5, 5. and 0x1p-3, too, rounded to the nearest double. Also nan and inf, and inf for
// what is too large: the caller decides about these. False: it is none of these, and `value` is unchanged.
bool read_c_number(std::string_view text, double& value);

// A whole number: [sign] digits. std::errc::invalid_argument: it is none (1.0 is not).
// std::errc::result_out_of_range: it has too many digits. `value` is then unchanged.
std::errc read_whole_number(std::string_view text, long long& value);

}  // namespace fc

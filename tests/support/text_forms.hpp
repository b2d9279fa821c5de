// The same text in the forms in which people's tools write it.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace fc_test {

// Each form with a name for messages. `text` ends its lines with \n alone.
inline std::vector<std::pair<std::string, std::string>> forms_of(const std::string& text) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> ends = {
      {"LF", {"\n"}}, {"CRLF", {"\r\n"}}, {"CR", {"\r"}}, {"mixed", {"\r\n", "\n", "\r"}}};
  std::vector<std::pair<std::string, std::string>> forms;
  for (const auto& [name, cycle] : ends) {
    std::string changed;
    std::size_t line = 0;
    for (char c : text) changed += c == '\n' ? cycle[line++ % cycle.size()] : std::string(1, c);
    forms.emplace_back(name, changed);
    forms.emplace_back("a byte order mark and " + name, "\xEF\xBB\xBF" + changed);
    forms.emplace_back("two byte order marks and " + name, "\xEF\xBB\xBF\xEF\xBB\xBF" + changed);
  }
  return forms;
}

// The number three as people write it: all that C's strtod takes for 3.
inline const std::vector<std::string> kThrees = {"3",     "+3",   "3.",     "3.0",    "+3.0E+00",
                                                 "30e-1", ".3e1", "+.3E+1", "0.03e2", "003.00",
                                                 "3e-0",  "0x3",  "0X1.8P1"};

// What is no number, or no finite one.
inline const std::vector<std::string> kNoNumbers = {"three", "3,0", "3.0.0",     "+-3",   "--3",
                                                    "3e",    "0x",  "0xinf",     "3d0",   "1_000",
                                                    "nan",   "inf", "-Infinity", "1e999", "-0x1p99999"};

}  // namespace fc_test

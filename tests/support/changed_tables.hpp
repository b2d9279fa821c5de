// Tables that programs wrote, changed line by line and cell by cell.
#pragma once

#include "tests/support/run_files.hpp"

namespace fc_test {

using Lines = std::vector<std::string>;

inline Lines lines_of(const std::filesystem::path& file) {
  std::stringstream stream(contents(file));
  Lines lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline void write(const std::filesystem::path& file, const Lines& lines) {
  std::ofstream stream(file);
  for (const std::string& line : lines) stream << line << '\n';
}

inline double cell(const std::string& line, int column) {
  return std::stod(split(line)[static_cast<std::size_t>(column)]);
}
inline std::string with(const std::string& line, int column, double value) {
  std::vector<std::string> cells = split(line);
  std::ostringstream text;
  text.precision(17);
  text << value;
  cells[static_cast<std::size_t>(column)] = text.str();
  std::string joined;
  for (const std::string& c : cells) joined += (joined.empty() ? "" : ",") + c;
  return joined;
}

}  // namespace fc_test

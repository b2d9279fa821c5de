#include "common/table_reader.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace fc {
namespace {

std::vector<std::string> split(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t");
    const auto last = cell.find_last_not_of(" \t");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

}  // namespace

SourceMark ReadTable::mark(const Row& row, int column) const {
  int at = 1;
  for (int k = 0; k < column; ++k) at += static_cast<int>(row.cells[k].size()) + 1;
  return {file, row.line, at};
}

double ReadTable::number(const Row& row, int column) const {
  const std::string& cell = row.cells[column];
  double value = 0;
  const char* end = cell.data() + cell.size();
  const auto [rest, error] = std::from_chars(cell.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value))
    throw InputError(mark(row, column),
                     "\"" + cell + "\" is not a finite number; write one, for example 0.5");
  return value;
}

ReadTable read_table(const std::filesystem::path& file, const std::string& header) {
  ReadTable table{file.string(), {}};
  std::ifstream stream(file);
  if (!stream) throw InputError({table.file}, "cannot be read; check its path and permissions");
  const std::vector<std::string> names = split(header);
  std::string line;
  if (!std::getline(stream, line) || split(line) != names)
    throw InputError({table.file, 1, 1}, "the header must be " + header);
  for (int number = 2; std::getline(stream, line); ++number) {
    if (line.empty() || line == "\r") continue;
    table.rows.push_back({number, split(line)});
    if (table.rows.back().cells.size() != names.size())
      throw InputError({table.file, number, 1}, std::to_string(table.rows.back().cells.size()) +
                                                    " cells; a row has " + std::to_string(names.size()) +
                                                    ", as the header");
  }
  return table;
}

}  // namespace fc

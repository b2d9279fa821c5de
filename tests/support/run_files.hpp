// Executables run from outside, and what they write read back: CSV tables by a reader of the tests' own.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace fc_test {

// A folder of this process; tests run in parallel.
inline std::filesystem::path scratch(const std::string& name) {
  const auto path = std::filesystem::path(testing::TempDir()) / ("fc_run_" + std::to_string(getpid())) / name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

// Runs a command line of the shell.
inline Outcome run(const std::string& command) {
  const auto here = scratch("output");
  const int status = std::system(
      (command + " >'" + (here / "out").string() + "' 2>'" + (here / "err").string() + "'").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(here / "out"), contents(here / "err")};
}

struct Table {
  std::vector<std::string> columns;             // with units
  std::vector<std::vector<std::string>> cells;  // row by row

  int rows() const { return static_cast<int>(cells.size()); }
  std::string header() const {
    std::string line;
    for (const std::string& column : columns) line += (line.empty() ? "" : ",") + column;
    return line;
  }
  int column(const std::string& name) const {  // by its name without the unit
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].substr(0, columns[i].find(" [")) == name) return static_cast<int>(i);
    throw std::runtime_error("no column " + name);
  }
  double at(int row, const std::string& name) const {
    return std::strtod(cells[row][column(name)].c_str(), nullptr);
  }
};

// The cells of a line; those with a comma stand in quotes.
inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

inline Table read_table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Table table;
  std::string line;
  std::getline(stream, line);
  table.columns = split(line);
  while (std::getline(stream, line)) table.cells.push_back(split(line));
  return table;
}

// The table's text without the columns whose name ends in _ns: what two runs must have in common.
inline std::string without_times(const Table& table) {
  std::string text = table.header();
  for (const auto& row : table.cells) {
    text += '\n';
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!table.columns[i].ends_with("_ns")) text += row[i] + ',';
  }
  return text;
}

// Whether every row is as long as the header, and no cell is empty.
inline bool is_full(const Table& table) {
  for (const auto& row : table.cells) {
    if (row.size() != table.columns.size()) return false;
    for (const std::string& cell : row)
      if (cell.empty() || cell == "nan" || cell == "-nan") return false;
  }
  return true;
}

}  // namespace fc_test

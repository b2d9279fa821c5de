#include "common/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "common/input_file.hpp"
#include "common/number_text.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

constexpr std::string_view kBlanks = " \t";

// A cell without the blanks around it, and without quotes: a quote inside quotes is written twice.
std::string unquoted(std::string_view cell, const SourceMark& where) {
  if (!cell.starts_with('"')) return std::string(cell);
  std::string text;
  for (std::size_t i = 1; i < cell.size(); ++i) {
    if (cell[i] == '"') {
      if (i + 1 == cell.size()) return text;
      if (cell[++i] != '"') break;
    }
    text += cell[i];
  }
  throw InputError(where,
                   "a quote begins here and does not end with the cell; write the cell without quotes");
}

ReadTable::Row split(std::string_view line, int number, const std::string& file) {
  ReadTable::Row row{number, {}, {}};
  for (std::size_t begin = 0; begin <= line.size();) {
    bool in_quotes = false;
    std::size_t end = begin;
    for (; end < line.size() && (in_quotes || line[end] != ','); ++end) in_quotes ^= line[end] == '"';
    std::string_view cell = line.substr(begin, end - begin);
    const std::size_t blanks = std::min(cell.find_first_not_of(kBlanks), cell.size());
    cell.remove_prefix(blanks);
    cell = cell.substr(0, cell.find_last_not_of(kBlanks) + 1);  // npos + 1 = 0
    row.columns.push_back(static_cast<int>(begin + blanks) + 1);
    row.cells.push_back(unquoted(cell, {file, number, row.columns.back()}));
    begin = end + 1;
  }
  return row;
}

void check_header(const ReadTable::Row& found, const std::string& header, std::string_view line,
                  const std::string& file) {
  const std::vector<std::string> names = split(header, 1, file).cells;
  if (found.cells == names) return;
  const std::string must = "; the header must be " + header;
  const bool other_commas = found.cells.size() == 1 && names.size() > 1;
  if (other_commas && line.find_first_of(";\t") != std::string_view::npos)
    throw InputError({file, found.line, 1}, "the cells are not separated by commas" + must);
  const std::size_t both = std::min(names.size(), found.cells.size());
  for (std::size_t k = 0; k < both; ++k) {
    if (found.cells[k] != names[k])
      throw InputError({file, found.line, found.columns[k]},
                       in_quotes(found.cells[k]) + " stands where " + in_quotes(names[k]) + " should" + must);
  }
  if (found.cells.size() > both)
    throw InputError({file, found.line, found.columns[both]},
                     in_quotes(found.cells[both]) + " is one name too many" + must);
  throw InputError({file, found.line, static_cast<int>(line.size()) + 1},
                   in_quotes(names[both]) + " is missing" + must);
}

}  // namespace

SourceMark ReadTable::mark(const Row& row, int column) const {
  return {file, row.line, row.columns[column]};
}

double ReadTable::number(const Row& row, int column) const {
  double value = 0;
  if (!read_c_number(row.cells[column], value) || !std::isfinite(value))
    throw InputError(mark(row, column),
                     "\"" + row.cells[column] + "\" is not a finite number; write one, for example 0.5");
  return value;
}

ReadTable read_table(const std::filesystem::path& file, const std::string& header) {
  InputFile input = read_input_file(file, "a table");
  refuse_other_kind(input, "a table");
  make_text(input, "a table");
  ReadTable table{file.string(), {}};
  std::size_t names = 0;
  std::string_view rest = input.bytes;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.find_first_not_of(kBlanks) == std::string_view::npos) continue;
    ReadTable::Row row = split(line, number, table.file);
    if (names == 0) {
      check_header(row, header, line, table.file);
      names = row.cells.size();
      continue;
    }
    if (row.cells.size() != names)
      throw InputError({table.file, number, row.columns[std::min(names, row.cells.size() - 1)]},
                       std::to_string(row.cells.size()) + " cells; a row has " + std::to_string(names) +
                           ", as the header");
    table.rows.push_back(std::move(row));
  }
  if (names == 0) throw InputError({table.file, 1, 1}, "the file is empty; the header must be " + header);
  return table;
}

}  // namespace fc

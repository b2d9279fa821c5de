// CSV tables with units in their headers.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace fc {

// A cell: numbers print in the shortest form that reads back to the same value ("0.1", "inf").
using Cell = std::variant<double, std::int64_t, std::string>;

// The cell as it prints, without quotes.
std::string cell_text(const Cell& cell);

struct Column {
  std::string name;  // "kinetic"
  std::string unit;  // "J"; "" = none, the header then has no brackets
};

// Writes one table. A row with the wrong number of cells, an empty text or a NaN throws NumericalFailure: no
// table of ours has an empty or undefined cell. Failure to write (disk full) throws too.
class TableWriter {
 public:
  TableWriter(const std::filesystem::path& file, std::vector<Column> columns);
  ~TableWriter();
  TableWriter(TableWriter&&) noexcept;

  void row(std::initializer_list<Cell> cells) { row(std::vector<Cell>(cells)); }
  void row(const std::vector<Cell>& cells);
  void close();  // flushes and checks; the destructor does the same without the check

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace fc

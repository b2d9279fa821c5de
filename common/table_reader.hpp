// CSV tables read back: those that people write (motions files) and those that our programs wrote.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/errors.hpp"

namespace fc {

struct ReadTable {
  struct Row {
    int line;                        // in the file, 1-based
    std::vector<std::string> cells;  // as many as the header has, without the blanks around them
  };

  std::string file;
  std::vector<Row> rows;  // empty lines are passed over

  // Where a cell starts.
  SourceMark mark(const Row& row, int column) const;
  // The cell as a number, which std::from_chars reads. Throws InputError if it is none, or not finite.
  double number(const Row& row, int column) const;
};

// Reads a table whose header must be the given one. Throws InputError for a file that cannot be read, another
// header, or a row with another number of cells.
ReadTable read_table(const std::filesystem::path& file, const std::string& header);

}  // namespace fc

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
    std::vector<std::string> cells;  // as many as the header has, without the blanks and quotes around them
    std::vector<int> columns;        // where each begins in its line, 1-based
  };

  std::string file;
  std::vector<Row> rows;  // blank lines are skipped

  // Where a cell starts.
  SourceMark mark(const Row& row, int column) const;
  // The cell as a number, in any form that C's strtod reads. Throws InputError if it is none, or not finite.
  double number(const Row& row, int column) const;
};

// Reads a table whose header must be `header`: text with any line ends, with or without a byte order mark.
// Throws InputError for a file that cannot be read or is not text, another header (naming the first name that
// differs), a row with another number of cells, or a quote that does not end in its cell.
ReadTable read_table(const std::filesystem::path& file, const std::string& header);

}  // namespace fc

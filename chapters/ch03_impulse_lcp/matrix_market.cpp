#include "ch03_impulse_lcp/matrix_market.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "common/errors.hpp"
#include "common/text.hpp"
#include "common/text_cursor.hpp"

namespace fc::lcp {
namespace {

// 800 MB: beyond it a dense matrix is not what the user meant.
constexpr double kMostEntries = 1e8;
constexpr Eigen::Index kMostRows = 100'000'000;

std::string in_small_letters(std::string_view word) {
  std::string small(word);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

// What the first line says of the lines that follow.
struct Banner {
  bool array = false, symmetric = false, whole = false;
};

Banner read_banner(TextCursor& words) {
  if (in_small_letters(words.word()) != "%%matrixmarket") {
    words.fail(
        "not a Matrix Market file; its first line must be '%%MatrixMarket matrix array|coordinate "
        "real|integer general|symmetric'");
  }
  const std::string object = in_small_letters(words.word());
  if (object != "matrix") words.fail(in_quotes(object) + " is not supported; use matrix");
  const std::string format = in_small_letters(words.word());
  if (format != "array" && format != "coordinate")
    words.fail(in_quotes(format) + " is not supported; use array or coordinate");
  const std::string field = in_small_letters(words.word());
  if (field != "real" && field != "integer")
    words.fail("entries of type " + in_quotes(field) + " are not supported; use real or integer");
  const std::string symmetry = in_small_letters(words.word());
  if (symmetry != "general" && symmetry != "symmetric")
    words.fail("the symmetry " + in_quotes(symmetry) + " is not supported; use general or symmetric");
  words.end_line("the five words of the first line; remove it");
  return {format == "array", symmetry == "symmetric", field == "integer"};
}

// Goes to the next line that is neither empty nor a comment, unless the present one has words left.
void find_words(TextCursor& words, const char* what) {
  while (!words.at_end()) {
    TextCursor ahead = words;
    const std::string_view word = ahead.word();
    if (!word.empty() && !(word.front() == '%' && ahead.mark().column == 1)) return;
    words.next_line();
  }
  words.fail(std::string("the file ends before ") + what + "; is it complete?");
}

double number(TextCursor& words, bool whole) {
  const char* what = "an entry of the matrix";
  const std::string_view word = words.word();
  const double value = whole ? static_cast<double>(words.integer(word, what)) : words.number(word, what);
  if (!std::isfinite(value)) words.fail(in_quotes(word) + " stands for " + what + "; write a finite number");
  return value;
}

Eigen::Index count(TextCursor& words, const char* what, Eigen::Index least, Eigen::Index most) {
  const std::string_view word = words.word();
  const long long value = words.integer(word, what);
  if (value < least || value > most) {
    words.fail(in_quotes(word) + " stands for " + what + "; write a whole number from " +
               std::to_string(least) + " to " + std::to_string(most));
  }
  return value;
}

// One entry a line, column by column. In a vector, where the order is clear, a line may have several.
MatX read_array(TextCursor& words, const Banner& banner, Eigen::Index rows, Eigen::Index columns) {
  MatX matrix(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = banner.symmetric ? j : 0; i < rows; ++i) {
      find_words(words, "an entry of the matrix");
      matrix(i, j) = number(words, banner.whole);
      if (banner.symmetric) matrix(j, i) = matrix(i, j);
      if (rows > 1 && columns > 1) words.end_line("an entry; write one entry a line, column by column");
    }
  }
  return matrix;
}

MatX read_coordinates(TextCursor& words, const Banner& banner, Eigen::Index rows, Eigen::Index columns,
                      Eigen::Index entries) {
  MatX matrix = MatX::Zero(rows, columns);
  std::vector<bool> given(static_cast<std::size_t>(rows * columns));
  for (Eigen::Index k = 0; k < entries; ++k) {
    find_words(words, "an entry of the matrix");
    const Eigen::Index i = count(words, "a row", 1, rows) - 1;
    const Eigen::Index j = count(words, "a column", 1, columns) - 1;
    const bool mirrored = banner.symmetric && given[static_cast<std::size_t>(j + i * columns)];
    if (given[static_cast<std::size_t>(i + j * rows)] || mirrored) {
      words.fail("entry " + std::to_string(i + 1) + ", " + std::to_string(j + 1) +
                 " is given twice; keep one");
    }
    given[static_cast<std::size_t>(i + j * rows)] = true;
    matrix(i, j) = number(words, banner.whole);
    if (banner.symmetric) matrix(j, i) = matrix(i, j);
    words.end_line("an entry; write row, column and value, one entry a line");
  }
  return matrix;
}

}  // namespace

MatX read_matrix_market(const std::filesystem::path& path) {
  InputFile file = read_input_file(path, "a matrix");
  if (!file.bytes.starts_with("%%")) refuse_other_kind(file, "a Matrix Market file");
  make_text(file, "a Matrix Market file");
  TextCursor words(file);
  const Banner banner = read_banner(words);
  words.next_line();
  find_words(words, "the number of rows");
  const Eigen::Index rows = count(words, "the number of rows", 0, kMostRows);
  const Eigen::Index columns = count(words, "the number of columns", 0, kMostRows);
  if (static_cast<double>(rows) * static_cast<double>(columns) > kMostEntries) {
    words.fail("a dense matrix of " + std::to_string(rows) + " by " + std::to_string(columns) +
               " entries is too large; at most 1e8 entries");
  }
  const Eigen::Index entries =
      banner.array ? rows * columns : count(words, "the number of entries", 0, rows * columns);
  words.end_line("the matrix's size; write its entries below, one a line");
  if (banner.symmetric && rows != columns)
    words.fail("a symmetric matrix must be square; check the size line");
  MatX matrix = banner.array ? read_array(words, banner, rows, columns)
                             : read_coordinates(words, banner, rows, columns, entries);
  for (; !words.at_end(); words.next_line()) {
    const std::string_view word = words.word();
    if (!word.empty() && !(word.front() == '%' && words.mark().column == 1))
      words.fail(in_quotes(word) + " is one entry more than the size line says; check the size line");
  }
  return matrix;
}

void write_matrix_market(const std::filesystem::path& file, const MatX& matrix) {
  std::ofstream out(file);
  const bool symmetric = matrix.rows() == matrix.cols() && matrix.cols() > 1 && matrix == matrix.transpose();
  out << "%%MatrixMarket matrix array real " << (symmetric ? "symmetric" : "general") << "\n"
      << matrix.rows() << " " << matrix.cols() << "\n";
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = symmetric ? j : 0; i < matrix.rows(); ++i)
      out << fmt::format("{:.17g}\n", matrix(i, j));
  }
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace fc::lcp

#include "ch03_impulse_lcp/matrix_market.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "common/errors.hpp"

namespace fc::lcp {
namespace {

// 800 MB: beyond it a dense matrix is not what the user meant.
constexpr double kMostEntries = 1e8;

// The words of a file, one after the other, with the place of the last one.
class Words {
 public:
  explicit Words(const std::filesystem::path& file) : file_(file.string()) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse("cannot be read; check the path and its permissions");
    text_.assign(std::istreambuf_iterator<char>(stream), {});
  }

  // The next word of the file, comments and line ends skipped; empty at the end.
  std::string_view next() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        line_start_ = ++at_;
      } else if (c == '%' && at_ == line_start_) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (is_space(c)) {
        ++at_;
      } else {
        break;
      }
    }
    word_line_ = line_;
    word_column_ = static_cast<int>(at_ - line_start_) + 1;
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return std::string_view(text_).substr(start, at_ - start);
  }

  // The first line's words in lower case; refuses a file that does not begin as a Matrix Market file must.
  std::vector<std::string> banner() {
    const std::string line = text_.substr(0, text_.find('\n'));
    std::vector<std::string> words;
    for (std::size_t i = 0; i < line.size();) {
      const auto end = static_cast<std::size_t>(
          std::find_if(line.begin() + static_cast<std::ptrdiff_t>(i), line.end(), is_space) - line.begin());
      if (end > i) words.push_back(line.substr(i, end - i));
      i = end + 1;
    }
    if (words.size() != 5 || words[0] != "%%MatrixMarket") {
      refuse(
          "not a Matrix Market file; its first line must be '%%MatrixMarket matrix array|coordinate "
          "real|integer general|symmetric'");
    }
    for (std::string& word : words) {
      std::transform(word.begin(), word.end(), word.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    }
    return words;
  }

  double number(const char* what) {
    const std::string_view word = next_needed(what);
    double value = 0;
    if (!parse(word, value) || !std::isfinite(value)) refuse_word(word, what, "a finite number");
    return value;
  }

  Eigen::Index count(const char* what, Eigen::Index least, Eigen::Index most) {
    const std::string_view word = next_needed(what);
    Eigen::Index value = 0;
    if (!parse(word, value) || value < least || value > most) {
      refuse_word(word, what, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    return value;
  }

  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError({file_, word_line_, word_column_}, message);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  template <typename Number>
  static bool parse(std::string_view word, Number& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const char* end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    return result.ec == std::errc() && result.ptr == end;
  }

  std::string_view next_needed(const char* what) {
    const std::string_view word = next();
    if (word.empty()) refuse(std::string("the file ends before ") + what + "; is it complete?");
    return word;
  }

  // Shows at most the start of the word, and only what can be printed: the file may be binary.
  [[noreturn]] void refuse_word(std::string_view word, const char* what, const std::string& wanted) const {
    std::string shown(word.substr(0, 30));
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
    refuse("'" + shown + "' stands for " + what + "; write " + wanted);
  }

  std::string file_, text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1, word_line_ = 1, word_column_ = 1;
};

constexpr Eigen::Index kMostRows = 100'000'000;

MatX read_array(Words& words, bool symmetric, Eigen::Index rows, Eigen::Index columns) {
  MatX matrix(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = symmetric ? j : 0; i < rows; ++i) {
      matrix(i, j) = words.number("an entry of the matrix");
      if (symmetric) matrix(j, i) = matrix(i, j);
    }
  }
  return matrix;
}

MatX read_coordinates(Words& words, bool symmetric, Eigen::Index rows, Eigen::Index columns) {
  const Eigen::Index entries = words.count("the number of entries", 0, rows * columns);
  MatX matrix = MatX::Zero(rows, columns);
  std::vector<bool> given(static_cast<std::size_t>(rows * columns));
  for (Eigen::Index k = 0; k < entries; ++k) {
    const Eigen::Index i = words.count("a row", 1, rows) - 1;
    const Eigen::Index j = words.count("a column", 1, columns) - 1;
    const bool mirrored = symmetric && given[static_cast<std::size_t>(j + i * columns)];
    if (given[static_cast<std::size_t>(i + j * rows)] || mirrored) {
      words.refuse("entry " + std::to_string(i + 1) + ", " + std::to_string(j + 1) +
                   " is given twice; keep one");
    }
    given[static_cast<std::size_t>(i + j * rows)] = true;
    matrix(i, j) = words.number("an entry of the matrix");
    if (symmetric) matrix(j, i) = matrix(i, j);
  }
  return matrix;
}

}  // namespace

MatX read_matrix_market(const std::filesystem::path& file) {
  Words words(file);
  const std::vector<std::string> banner = words.banner();
  const bool array = banner[2] == "array", symmetric = banner[4] == "symmetric";
  if (banner[1] != "matrix" || (!array && banner[2] != "coordinate")) {
    words.refuse("'" + banner[1] + " " + banner[2] +
                 "' is not supported; use 'matrix array' or 'matrix coordinate'");
  }
  if (banner[3] != "real" && banner[3] != "integer") {
    words.refuse("entries of type '" + banner[3] + "' are not supported; use real or integer");
  }
  if (!symmetric && banner[4] != "general") {
    words.refuse("the symmetry '" + banner[4] + "' is not supported; use general or symmetric");
  }

  const Eigen::Index rows = words.count("the number of rows", 0, kMostRows);
  const Eigen::Index columns = words.count("the number of columns", 0, kMostRows);
  if (static_cast<double>(rows) * static_cast<double>(columns) > kMostEntries) {
    words.refuse("a dense matrix of " + std::to_string(rows) + " by " + std::to_string(columns) +
                 " entries is too large; at most 1e8 entries");
  }
  if (symmetric && rows != columns) words.refuse("a symmetric matrix must be square; check the size line");
  MatX matrix =
      array ? read_array(words, symmetric, rows, columns) : read_coordinates(words, symmetric, rows, columns);
  if (!words.next().empty()) words.refuse("more entries than the size line says; check the size line");
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

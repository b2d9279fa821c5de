// Words and numbers of a text file, with their places.
#pragma once

#include <string>
#include <string_view>

#include "common/errors.hpp"
#include "common/input_file.hpp"

namespace fc {

// Reads a file's text word by word, after make_text. The file must outlive it.
class TextCursor {
 public:
  explicit TextCursor(const InputFile& file, int first_line = 1) : file_(&file), line_(first_line) {}

  bool at_end() const { return at_ >= file_->bytes.size(); }
  std::size_t bytes_left() const { return file_->bytes.size() - at_; }
  // The rest of the line is empty.
  bool at_line_end();
  // Whether this line's last character is a backslash.
  bool line_continues() const;
  void next_line();
  // The next word of this line; empty at the line's end.
  std::string_view word();
  // The next word of this or a later line; empty at the file's end.
  std::string_view word_across_lines();
  // The given word, or the next one, as a number or a whole number. `what` names it in the message if it is
  // not one.
  double number(std::string_view word, const char* what) const;
  double number(const char* what) { return number(word(), what); }
  long long integer(std::string_view word, const char* what) const;
  long long integer(const char* what) { return integer(word(), what); }
  // Refuses a further word in this line, with `message`.
  void end_line(const char* message);

  // Stops reading, pointing to the last word, or to the place where one is missing.
  [[noreturn]] void fail(const std::string& message) const;
  SourceMark mark() const { return {file_->path.string(), line_, static_cast<int>(last_ - line_start_) + 1}; }

 private:
  const InputFile* file_;
  std::size_t at_ = 0, line_start_ = 0, last_ = 0;
  int line_;
};

}  // namespace fc

#include "common/text_cursor.hpp"

#include <algorithm>

#include "common/number_text.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

}  // namespace

bool TextCursor::at_line_end() {
  const std::string& s = file_->bytes;
  while (at_ < s.size() && is_blank(s[at_])) ++at_;
  return at_ >= s.size() || s[at_] == '\n';
}

bool TextCursor::line_continues() const {
  const std::size_t end = std::min(file_->bytes.find('\n', at_), file_->bytes.size());
  return end > line_start_ && file_->bytes[end - 1] == '\\';
}

void TextCursor::next_line() {
  at_ = std::min(file_->bytes.find('\n', at_), file_->bytes.size());
  if (at_ < file_->bytes.size()) ++at_;
  line_start_ = last_ = at_;
  ++line_;
}

std::string_view TextCursor::word() {
  const bool none = at_line_end();
  last_ = at_;
  if (none) return {};
  const std::string& s = file_->bytes;
  while (at_ < s.size() && s[at_] != '\n' && !is_blank(s[at_])) ++at_;
  return std::string_view(s).substr(last_, at_ - last_);
}

std::string_view TextCursor::word_across_lines() {
  while (at_line_end() && !at_end()) next_line();
  return word();
}

double TextCursor::number(std::string_view word, const char* what) const {
  if (word.empty()) fail(std::string("the line ends where ") + what + " should stand; complete it");
  double value = 0;
  if (!read_c_number(word, value))
    fail("expected " + std::string(what) + ", found " + in_quotes(word) + "; write a number");
  return value;
}

long long TextCursor::integer(std::string_view word, const char* what) const {
  if (word.empty()) fail(std::string("the line ends where ") + what + " should stand; complete it");
  long long value = 0;
  if (read_whole_number(word, value) != std::errc())
    fail("expected " + std::string(what) + ", found " + in_quotes(word) + "; write a whole number");
  return value;
}

void TextCursor::end_line(const char* message) {
  if (at_line_end()) return;
  const std::string_view extra = word();
  fail("found " + in_quotes(extra) + " after " + message);
}

void TextCursor::fail(const std::string& message) const {
  throw InputError(mark(), message);
}

}  // namespace fc

// The two failures that end a program, and the check that raises one of them.
//
// Everything else that can go wrong in an algorithm is a status in its result (design 2.3). A caller's
// mistake in the C++ interface throws std::invalid_argument.
#pragma once

#include <stdexcept>
#include <string>

namespace fc {

// Where a value comes from: a place in a file (1-based; 0 = not known), or the command line option that set
// it.
struct SourceMark {
  std::string file;
  int line = 0;
  int column = 0;

  // "scene.yaml:12:5", "scene.yaml" or "--set gravity=1".
  std::string text() const {
    if (line == 0) return file;
    return file + ":" + std::to_string(line) + ":" + std::to_string(column);
  }
};

// Bad input: one line on standard error, exit code 2. `what()` is "file:line:column: what is wrong; what to
// do".
class InputError : public std::runtime_error {
 public:
  InputError(const SourceMark& where, const std::string& message)
      : std::runtime_error(where.text().empty() ? message : where.text() + ": " + message) {}
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

// A numerical failure that the program detected: one line on standard error, exit code 3; what was written
// stays.
class NumericalFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace fc

// An invariant of an algorithm. It is always checked; when broken, the run ends with exit code 3 and this
// line.
#define FC_CHECK(condition, message)                                                                         \
  do {                                                                                                       \
    if (!(condition))                                                                                        \
      throw ::fc::NumericalFailure(std::string(__FILE__ ":") + std::to_string(__LINE__) + ": " + (message)); \
  } while (false)

// The placeholder for a learner's code in an exercise.
#pragma once

#include <stdexcept>
#include <string>

namespace fc {

// Thrown by code that nobody has written yet.
struct TodoError : std::logic_error {
  explicit TodoError(const std::string& exercise)
      : std::logic_error("TODO: exercise " + exercise + " is still to be written; exercises/ch0" +
                         exercise.substr(0, 1) + "/README.md says what") {}
};

}  // namespace fc

// Stands where exercise "1.2" (chapter 1, the second one) wants code. Delete it when you begin.
#define FC_TODO(exercise) throw ::fc::TodoError(exercise)

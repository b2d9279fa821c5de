// A numerical failure that the scene can do something about.
#pragma once

#include <string>
#include <utility>

#include "common/errors.hpp"

namespace fc {

// The message says what to change, and `key` names the scene key that it is about ("solver.limit"): the line that
// a program prints begins with the place of that key. FC_CHECK, with a line of ours, is for our own mistakes.
class SceneFailure : public NumericalFailure {
 public:
  SceneFailure(const std::string& message, std::string key)
      : NumericalFailure(message), key_(std::move(key)) {}
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

}  // namespace fc

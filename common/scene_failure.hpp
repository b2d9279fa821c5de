// A numerical failure that a change of the scene may cure.
#pragma once

#include <string>
#include <utility>

#include "common/errors.hpp"

namespace fc {

// The message says what to change, and `key` names the scene key that it is about ("solver.limit"): the line that
// a program prints begins with the place of that key. FC_CHECK, which names a line of the source, is for our own
// mistakes.
class SceneFailure : public NumericalFailure {
 public:
  SceneFailure(const std::string& message, std::string key)
      : NumericalFailure(message), key_(std::move(key)) {}
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

}  // namespace fc

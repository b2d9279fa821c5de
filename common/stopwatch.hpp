// How long something takes.
#pragma once

#include <chrono>
#include <cstdint>

namespace fc {

// Runs from its construction on.
class Stopwatch {
 public:
  std::int64_t ns() const {
    return (std::chrono::steady_clock::now() - start_) / std::chrono::nanoseconds(1);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace fc

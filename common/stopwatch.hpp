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

// Adds the time of its own life to a sum, ns.
class TimeInto {
 public:
  explicit TimeInto(std::int64_t& sum) : sum_(sum) {}
  ~TimeInto() { sum_ += watch_.ns(); }
  TimeInto(const TimeInto&) = delete;
  TimeInto& operator=(const TimeInto&) = delete;

 private:
  std::int64_t& sum_;
  Stopwatch watch_;
};

}  // namespace fc

// Where the simulation's thread leaves its newest messages, and the threads of the pages pick them up.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace fc::live {

// A message that nobody changes any more: encoded once, shared by all pages. Of one kind, the number counts up.
struct Notice {
  std::shared_ptr<const std::string> message;  // nullptr: there is none
  std::uint64_t number = 0;
};

struct News {
  Notice frame, twin, state;
  bool closed = false;  // nothing will follow
};

// The lock is held for the exchange of a pointer, never while something is computed or sent. A page that is slow sees the
// newest message and misses those between.
class Board {
 public:
  // Without a copy `twin` is empty; then a page that comes later gets no frame of it.
  void post(std::string frame, std::optional<std::string> twin, std::optional<std::string> state);
  void close();

  News news() const;
  // Waits for a message that is newer than these, for the end, or as long as said.
  News wait(std::uint64_t frame, std::uint64_t state, std::chrono::milliseconds longest) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  News news_;
};

}  // namespace fc::live

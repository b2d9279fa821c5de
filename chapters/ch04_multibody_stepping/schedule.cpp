#include "ch04_multibody_stepping/schedule.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace fc::world {

// The structure of the tree is kept for this many frames: bodies do not move far meanwhile.
constexpr int kFramesOfATree = 16;

void Schedule::begin(std::span<const Bounds> boxes) {
  if (tree_.size() == static_cast<int>(boxes.size()) && frames_ < kFramesOfATree) {
    tree_.refit(boxes);
    ++frames_;
  } else {
    tree_.build(boxes);
    frames_ = 0;
  }
  pairs_.clear();
  closed_.clear();
  queue_.clear();
  pairs_of_.resize(boxes.size());
  for (std::vector<int>& pairs : pairs_of_) pairs.clear();
}

void Schedule::replace(int body, const Bounds& box) {
  tree_.replace(body, box);
  for (const int number : pairs_of_[static_cast<std::size_t>(body)]) {
    const Pair& p = pair(number);
    std::erase(pairs_of_[static_cast<std::size_t>(p.a == body ? p.b : p.a)], number);
    close(number);
  }
  pairs_of_[static_cast<std::size_t>(body)].clear();
}

int Schedule::open(int a, int b) {
  int number = static_cast<int>(pairs_.size());
  if (closed_.empty()) {
    pairs_.emplace_back();
  } else {
    number = closed_.back();
    closed_.pop_back();
  }
  Pair& p = pair(number);
  p.a = std::min(a, b);
  p.b = std::max(a, b);
  p.open = true;
  for (const int body : {a, b}) pairs_of_[static_cast<std::size_t>(body)].push_back(number);
  return number;
}

int Schedule::find(int a, int b) const {
  if (pairs_of(a).size() > pairs_of(b).size()) std::swap(a, b);  // a floor has many
  for (const int number : pairs_of(a)) {
    if (pair(number).a == b || pair(number).b == b) return number;
  }
  return -1;
}

void Schedule::close(int number) {
  pair(number).open = false;
  ++pair(number).answers;  // its events still in the queue are void
  closed_.push_back(number);
}

void Schedule::answered(int number, double end) {
  Pair& p = pair(number);
  ++p.answers;
  if (!(p.time < end)) return;
  queue_.push_back({p.time, p.a, p.b, number, p.answers});
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

double Schedule::next_time() {
  while (!queue_.empty()) {
    const Event& event = queue_.front();
    if (pair(event.number).open && pair(event.number).answers == event.answer) return event.time;
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
  }
  return std::numeric_limits<double>::infinity();
}

int Schedule::next() {
  if (next_time() == std::numeric_limits<double>::infinity()) return -1;
  std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
  const int number = queue_.back().number;
  queue_.pop_back();
  return number;
}

}  // namespace fc::world

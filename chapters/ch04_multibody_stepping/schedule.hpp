// What may happen next: the pairs of bodies that come near each other in this frame, and a queue of their
// next contacts.
#pragma once

#include <span>
#include <vector>

#include "ch04_multibody_stepping/broad_phase.hpp"

namespace fc::world {

// Two bodies of which at least one can move, whose swept boxes overlap, and what is known of their next
// contact in this frame.
struct Pair {
  int a = 0, b = 0;      // a < b
  double time = 0;       // s in the frame: nothing happens before
  bool contact = false;  // at `time` the pair reaches its target gap (else it is clear until then)
  bool stalled = false;  // it has no gap left to spend, and closes in within the frame
  bool open = false;     // in use; closed when one of its bodies changes its motion
  int answers = 0;       // how often it was queried: an event of an earlier answer is void
};

// Pairs by number, and the numbers of each body's pairs. Nothing here knows what a body is.
class Schedule {
 public:
  // A new frame: no pairs, no events.
  void begin(std::span<const Bounds> boxes);
  // The body's box has changed. Closes its pairs.
  void replace(int body, const Bounds& box);
  template <class Visit>
  void overlapping(const Bounds& box, Visit&& visit) const {
    tree_.overlapping(box, visit);
  }

  template <class Visit>
  void overlapping_pairs(Visit&& visit) const {
    tree_.overlapping_pairs(visit);
  }

  int open(int a, int b);
  // The number of the open pair of two bodies; -1 if there is none.
  int find(int a, int b) const;
  Pair& pair(int number) { return pairs_[static_cast<std::size_t>(number)]; }
  const Pair& pair(int number) const { return pairs_[static_cast<std::size_t>(number)]; }
  const std::vector<int>& pairs_of(int body) const { return pairs_of_[static_cast<std::size_t>(body)]; }
  int size() const { return static_cast<int>(pairs_.size()); }  // numbers that are or were in use

  // The pair has a new answer. It counts as an event if its time is before `end`.
  void answered(int number, double end);
  // Takes the earliest event off the queue. Returns its pair's number; -1 if there is no event. Events at the same time
  // come in the order of their bodies' numbers.
  int next();
  double next_time();  // of that event, s in the frame; infinite if there is none

 private:
  struct Event {
    double time;
    int a, b, number, answer;
    bool operator>(const Event& other) const {
      if (time != other.time) return time > other.time;
      return a != other.a ? a > other.a : b > other.b;
    }
  };
  void close(int number);

  BoundsTree tree_;
  int frames_ = 0;  // since the tree was built
  std::vector<Pair> pairs_;
  std::vector<int> closed_;  // numbers to be used again
  std::vector<std::vector<int>> pairs_of_;
  std::vector<Event> queue_;  // a heap, the earliest first
};

}  // namespace fc::world

// How much work an island may take from event to event.
#pragma once

#include <vector>

#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// Work is the number of times that a solver looks at a contact, so it is the same on every machine. An island that exceeds the
// budget of a frame becomes a pile for the rest of the frame and for some frames more; each time it exceeds it again, for twice as
// many. An island that stands at the frame's end is exempt: its balance may be dear to find, and then costs nothing.
class WorkBudget {
 public:
  explicit WorkBudget(std::size_t bodies) : bodies_(bodies) {}
  void next_frame();
  // What the island took; most: a frame's. rest_speed: m/s, a margin in a frame, if the frame is over; else 0.
  void add(const Island& island, double work, double most, double rest_speed);
  bool is_spent(const Island& island) const;

 private:
  struct Account {
    double work = 0;  // in this frame, with its island
    int waits = 0;    // frames for which it is still a pile
    int waited = 0;   // frames for which it was one the last time
    bool spent = false;
  };
  std::vector<Account> bodies_;
};

}  // namespace fc::resting

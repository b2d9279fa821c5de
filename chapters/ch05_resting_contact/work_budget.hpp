// How much work an island may take from event to event.
#pragma once

#include <vector>

#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// Work is counted in contacts that a solver has looked at: so it is the same on every machine. An island that takes more than a
// frame should is a pile for the rest of it, and for some frames, which double each time. But who stands afterwards is forgiven:
// balance may take much to find, and then costs nothing.
class WorkBudget {
 public:
  explicit WorkBudget(std::size_t bodies) : bodies_(bodies) {}
  void next_frame();
  // most: a frame's.
  void add(const Island& island, double work, double most);
  // The frame is over. rest_speed: m/s, a margin in a frame.
  void forgive(const Island& island, double rest_speed);
  bool is_spent(const Island& island) const;

 private:
  struct Account {
    double work = 0;  // in this frame, with its island
    int waits = 0;    // so many frames more,
    int waited = 0;   // after so many
    bool spent = false;
  };
  std::vector<Account> bodies_;
};

}  // namespace fc::resting

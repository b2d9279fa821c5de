// Driven bodies go where they are driven to: nothing stops one that goes into a static one, or into another driven one. It is told.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "ch05_resting_contact/contacts.hpp"

namespace fc::resting {

// A driven body runs into one that cannot give way either.
struct Clash {
  int driven, other;  // by their numbers in the world
  double time;        // s, from when look() looks on
};

class DrivenWatch {
 public:
  // The clashes of the next dt seconds; each pair is told once. Those that start in touch clash if they go deeper by more than
  // the tolerance.
  std::vector<Clash> look(const world::World& world, Contacts& contacts, double dt);

 private:
  std::set<std::pair<int, int>> told_;
};

}  // namespace fc::resting

// A kinematic body that goes into a static one, or into another kinematic one: nothing stops it, so the program has to say so.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "ch05_resting_contact/contacts.hpp"

namespace fc::resting {

// A kinematic body runs into one that cannot give way either.
struct Clash {
  int kinematic, other;  // by their numbers in the world
  double time;           // s, from when look() looks on
};

class KinematicWatch {
 public:
  // The clashes of the next dt seconds, each pair only the first time. A pair that touches at the start clashes if its overlap
  // grows by more than the tolerance; a pair with a mesh that touches at the start is not looked at.
  std::vector<Clash> look(const world::World& world, Contacts& contacts, double dt);

 private:
  std::set<std::pair<int, int>> reported_;
};

}  // namespace fc::resting

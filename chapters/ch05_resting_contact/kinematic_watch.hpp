// A kinematic body that runs into a static or another kinematic one: nothing stops it, so the program reports it.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "ch05_resting_contact/contacts.hpp"

namespace fc::resting {

// A kinematic body runs into a body that cannot give way either.
struct Clash {
  int kinematic, other;  // by their numbers in the world
  double time;           // s, from the time of the call of look()
};

class KinematicWatch {
 public:
  // The clashes of the next dt seconds; each pair is reported only the first time. A pair that touches at the start
  // clashes if its overlap grows by more than the tolerance; a pair with a mesh that touches at the start is not
  // examined.
  std::vector<Clash> look(const world::World& world, Contacts& contacts, double dt);

 private:
  std::set<std::pair<int, int>> reported_;
};

}  // namespace fc::resting

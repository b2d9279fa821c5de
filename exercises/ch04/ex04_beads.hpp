// Exercise 4.4: an event queue of your own: beads on a wire.
#pragma once

#include <cstdint>
#include <vector>

namespace fc::exercises {

// A point on a line.
struct Bead {
  double place = 0;     // m
  double velocity = 0;  // m/s
  double mass = 1;      // kg, > 0
};

struct BeadsResult {
  std::int64_t collisions = 0;
  std::int64_t events = 0;  // events put into the queue
};

// Lets the beads, given from left to right, fly for `duration` (s, >= 0): with constant velocities, and elastic
// collisions of neighbours, one after the other in time. Afterwards every bead has its place and velocity at that time.
// (A collision exactly at the end is left to the next flight.) Guarantees: the order of the beads never changes (by
// more than rounding); every collision happens, and none twice; energy and momentum are conserved; there is at most one
// event for each pair of neighbours at the start, and three for each collision, so that the cost of a collision does
// not grow with the number of beads.
BeadsResult fly(std::vector<Bead>& beads, double duration);

}  // namespace fc::exercises

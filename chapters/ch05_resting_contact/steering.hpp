// Gaps put right by positions alone.
#pragma once

#include "ch05_resting_contact/island_solver.hpp"
#include "ch05_resting_contact/islands.hpp"

namespace fc::resting {

struct Steering {
  double way = 0;     // m, the largest that a body's point was moved
  double energy = 0;  // J, potential energy that this added
};

// Moves bodies, and leaves their velocities alone: the least motion, in the sense of kinetic energy, that
// brings each gap of the shell that is below the envelope's middle a part of the way there, and no other gap
// below it. The shell is found anew first. No gap loses more than half of what it has.
Steering steer(world::World& world, Shell& shell, IslandSolver& solver);

}  // namespace fc::resting

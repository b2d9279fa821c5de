// Sleep: a body that has been frozen in place for long enough is put to rest, and costs nothing until something hits
// it.
#pragma once

#include <vector>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

// At a frame's end, before the bodies are advanced to it: counts for how long each has been frozen, and puts those to
// sleep that meet the scene's `sleep` (World::effects). A sleeping body has no velocity and no spin; the kinetic energy
// that it gives up is reported.
void fall_asleep(World& world, double dt, StepReport& report);

// Wakes those of the given bodies that sleep, at `now` (s in the frame), and every sleeper that one of them touches,
// and so on: a body that lies on them may have lost its support. Appends all that woke to `bodies`.
void wake(World& world, double now, std::vector<int>& bodies, StepReport& report);

}  // namespace fc::world

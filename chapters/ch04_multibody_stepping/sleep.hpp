// Sleep: a body that was frozen in place for long enough is at rest, and costs nothing, until something hits
// it.
#pragma once

#include <vector>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

// At a frame's end, before the bodies are advanced there: counts for how long each has been frozen, and lets
// those fall asleep that the scene's `sleep` lets (World::effects). A sleeping body has no velocity and no
// spin; what energy it gave up for that is reported.
void fall_asleep(World& world, double dt, StepReport& report);

// Wakes the given bodies (those that sleep) at `now` (s in the frame), and every sleeper that one of them
// touches, and so on: what lies on them may have lost its support. Appends all that woke to `bodies`.
void wake(World& world, double now, std::vector<int>& bodies, StepReport& report);

}  // namespace fc::world

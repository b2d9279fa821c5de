// Islands that fall asleep together, and wake together.
#pragma once

#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// An island that an awake body touches is awake.
void wake(world::World& world, std::span<const Member> members, world::StepReport& report);

// At a frame's end: islands that lie on what does not move, and whose bodies have all been slow for as long as the scene says.
void fall_asleep(world::World& world, IslandFinder& islands, double dt, world::StepReport& report);

}  // namespace fc::resting

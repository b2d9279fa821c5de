// Islands that fall asleep together, and wake together.
#pragma once

#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// Wakes the island if an awake body touches it.
void wake(world::World& world, std::span<const Member> members, world::StepReport& report);

// At a frame's end: puts to sleep the islands that lie on what does not move, and whose bodies have all been slow for
// as long as the scene asks.
void fall_asleep(world::World& world, IslandFinder& islands, double dt, world::StepReport& report);

}  // namespace fc::resting

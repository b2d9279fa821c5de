// Sensors: bodies whose contacts are reported, not resolved.
#pragma once

#include <optional>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

// Whether one of the two is a sensor: then nothing is resolved between them.
inline bool is_sensor_pair(const World& world, int a, int b) {
  return world.bodies[a].sensor || world.bodies[b].sensor;
}

// Queries a pair with a sensor at `now` (s in the frame). `touching` becomes whether they touch (gap within the
// tolerance), overlap, or one is inside the other. Returns what to report: a sighting if they touch and did not when
// they were last queried.
std::optional<Sighting> look(World& world, int a, int b, double now, bool& touching);

}  // namespace fc::world

// Sensors: bodies whose contacts are reported, not resolved.
#pragma once

#include <optional>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

// Whether one of the two is a sensor: nothing is resolved between them.
inline bool is_sensor_pair(const World& world, int a, int b) {
  return world.bodies[a].sensor || world.bodies[b].sensor;
}

// Looks at a pair with a sensor at `now` (s in the frame): whether they touch (gap within the tolerance),
// overlap, or one is inside the other. The result is what to report: a sighting if they touch and did not
// when they were last looked at. `touching` says whether they touch.
std::optional<Sighting> look(World& world, int a, int b, double now, bool& touching);

}  // namespace fc::world

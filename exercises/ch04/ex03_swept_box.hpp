// Exercise 4.3: a box around everything that a spinning, falling block reaches in a frame.
#pragma once

#include "ch04_multibody_stepping/broad_phase.hpp"
#include "common/rigid_body.hpp"

namespace fc::exercises {

// A block with these half edges (m) about its centre of mass, whose state is `start` at time 0. It flies with constant
// acceleration (m/s^2, world) and constant spin for dt seconds (>= 0). The result contains every point of the block at
// every time in [0, dt] (up to rounding, 1e-12 of the coordinates). Its two parts are tight: if the block does not
// turn, or its centre does not move, no smaller box will do. The centre's path and the turning may be bounded one after
// the other: neither part alone is longer than the smallest box, so no side is more than twice as long as that of the
// smallest box.
world::Bounds swept_box(const Vec3& half, const RigidBody& start, const Vec3& acceleration, double dt);

}  // namespace fc::exercises

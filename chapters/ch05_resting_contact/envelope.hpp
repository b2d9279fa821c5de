// The collision envelope: a thin layer around every body, inside of which contacts last.
#pragma once

#include "ch04_multibody_stepping/world.hpp"

namespace fc::resting {

// The envelope's width in m: the scene's, or, if that is 0, a thousandth of the smallest reach of a shape that moves.
// Throws InputError if it is less than a hundred tolerances (chapter 4's contacts happen at half a tolerance, which
// must be small beside the envelope); if it is wider than half of the thinnest body; or if bodies fall so far in a
// frame of dt seconds that rounding is not small beside it.
double envelope_of(const Scene& scene, const world::World& world, double dt);

}  // namespace fc::resting

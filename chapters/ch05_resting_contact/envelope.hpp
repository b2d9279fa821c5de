// The collision envelope: a thin shell around every body, inside of which contacts last.
#pragma once

#include "ch04_multibody_stepping/world.hpp"

namespace fc::resting {

// The envelope's width in m: the scene's, or, if that is 0, a thousandth of the smallest reach of a shape
// that moves. Throws InputError if it is less than a hundred tolerances (a contact of chapter 4 happens at half a tolerance, and
// must stay a small thing beside the envelope); if it is wider than half of the thinnest body; or if bodies fall so far in a frame
// of dt seconds that rounding is not small against it.
double envelope_of(const Scene& scene, const world::World& world, double dt);

}  // namespace fc::resting

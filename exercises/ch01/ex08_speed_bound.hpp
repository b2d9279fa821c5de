// Exercise 1.8: how fast can two bodies close in along a direction?
#pragma once

#include "ch01_convex_advancement/clear/pieces.hpp"

namespace fc::mine {

using ca::clear::Mover;

// A bound, in m/s, of  n . (velocity of any point of A - velocity of any point of B)  at any time from now until `duration`
// (s) later.
//   n: unit, world, from A to B; it does not move.
//   a, b: what moves (clear/pieces.hpp says in which units); spins and accelerations are constant. Nothing is known of the
//     bodies' orientations, only their reach.
// A result <= 0 proves that they do not close in along n. It is the smallest such bound: if the bodies turn far enough,
// and have points at their reach across the spin, it is attained. (Rounding, about 1e-15 of it, does not matter here: the
// advancement keeps half of the tolerance in reserve.)
double speed_bound(const Vec3& n, const Mover& a, const Mover& b, double duration);

}  // namespace fc::mine

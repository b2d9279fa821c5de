// A world that runs on pieces: the clear versions of chapters 1 to 4, or a learner's (--clear, --mine).
#pragma once

#include "ch04_multibody_stepping/clear/pieces.hpp"
#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

// From now on the next contact of a pair is searched for in trees of hulls, an instant's impulses are found by the dense
// Dantzig, and the gap rule and the loop are those of `pieces`, which must outlive the world. (What a contact looks like, and
// which boxes overlap, is found as ever; two balls still meet by a quadratic equation.) Throws InputError for what the clear
// search does not know: shapes that are not hulls of points, motions whose spin or acceleration changes.
void put_on_pieces(World& world, const Scene& scene, const clear::Pieces& pieces);

}  // namespace fc::world

// A world that runs on pieces: the clear versions of chapters 1 to 4, or a learner's (--clear, --mine).
#pragma once

#include "ch04_multibody_stepping/clear/pieces.hpp"
#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

// From now on the world uses `pieces`, which must outlive it: the search in trees of hulls for a pair's next contact,
// the dense Dantzig solver for an instant's impulses, the gap rule and the loop. (Contact features and overlapping
// boxes are found as before; two balls still meet by a quadratic equation.) Throws InputError for what the clear search
// does not allow: shapes that are not hulls of points, and motions whose spin or acceleration changes.
void put_on_pieces(World& world, const Scene& scene, const clear::Pieces& pieces);

}  // namespace fc::world

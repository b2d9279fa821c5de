// The clear search in place of the fast one.
#pragma once

#include "ch02_hull_hierarchy/clear/pieces.hpp"
#include "ch02_hull_hierarchy/first_reach.hpp"

namespace fc::hulls {

// Same contract as first_reach, by the pieces' search. Both models have hulls (add_hulls); the motions' acceleration and
// spin are constant. Throws std::invalid_argument if not.
Reach reach_by_pieces(const Model& a, const ca::Motion& motion_a, const Model& b, const ca::Motion& motion_b,
                      const ReachOptions& options, const clear::Pieces& pieces);

}  // namespace fc::hulls

// The clear search in place of the fast one.
#pragma once

#include "ch02_hull_hierarchy/clear/pieces.hpp"
#include "ch02_hull_hierarchy/time_of_contact.hpp"

namespace fc::hulls {

// Same contract as time_of_contact, by the pieces' search. Both models have hulls (add_hulls); the motions' acceleration and
// spin are constant. Throws std::invalid_argument if not.
TimeOfContact toc_by_pieces(const Model& a, const ca::Motion& motion_a, const Model& b,
                            const ca::Motion& motion_b, const TocOptions& options,
                            const clear::Pieces& pieces);

}  // namespace fc::hulls

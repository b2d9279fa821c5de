// The first contact of two moving models, and the features that are in contact then.
#pragma once

#include "ch02_hull_hierarchy/time_of_contact.hpp"

namespace fc::hulls {

// Chapter 1's query (fc::ca::AdvanceOptions, AdvanceResult) for two models. Features are all pairs within the
// tolerance at toc (features.hpp). Throws std::invalid_argument as ca::check_query.
ca::AdvanceResult advance(const Model& a, const ca::Motion& motion_a, const Model& b,
                          const ca::Motion& motion_b, const ca::AdvanceOptions& options);
// The same; `memory` and `result` keep their storage for the next query.
void advance(const Model& a, const ca::Motion& motion_a, const Model& b, const ca::Motion& motion_b,
             const ca::AdvanceOptions& options, SearchMemory& memory, ca::AdvanceResult& result);

}  // namespace fc::hulls

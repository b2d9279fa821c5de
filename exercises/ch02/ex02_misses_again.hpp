// Exercise 2.2: why did it miss again?
#pragma once

#include <cstdint>
#include <vector>

#include "ch01_convex_advancement/query.hpp"
#include "ch02_hull_hierarchy/hull_model.hpp"

namespace fc::exercises {

struct FirstContact {
  ca::Status status = ca::Status::unresolved;  // contact, separated or unresolved
  double toc = 0;               // s: contact: when; unresolved: clear until then; separated: the interval
  std::vector<double> visited;  // s, the time at which each step began, from 0 on
  std::int64_t node_pairs = 0;  // whose distance was computed, in all steps
};

// The first contact of two bodies in [0, interval] (s), by one global step after another: at each time both
// hierarchies are searched from their roots down for the longest step that is safe for all pairs of leaves.
//   tolerance: m, > 0, and not so small that rounding counts: at least 1e-12 of the bodies' largest distance
//     from the origin and from their first places. `contact` means: at toc the gap is positive and at most the
//     tolerance.
//   most: the largest number of steps; if they do not suffice, the answer is `unresolved`.
// Guarantee: before toc the bodies do not touch. They start farther apart than the tolerance. A pair that
// cannot make the step shorter is not opened; of two nodes that may be opened, the larger one is.
FirstContact first_contact(const hulls::HullModel& a, const ca::Motion& motion_a, const hulls::HullModel& b,
                           const ca::Motion& motion_b, double interval, double tolerance, int most);

}  // namespace fc::exercises

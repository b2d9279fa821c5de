// Conservative advancement of two convex bodies to their first contact.
#pragma once

#include "ch01_convex_advancement/gjk.hpp"
#include "ch01_convex_advancement/query.hpp"

namespace fc::ca {

// The first contact of two moving convex shapes in [0, options.interval].
//
// A certified gap along a plane, and a bound on the speed at which the pair can close in along its normal,
// give a time during which nothing can happen. The pair is moved to the end of that time, again and again,
// until the gap is within the tolerance (`contact`), or until the interval is over or the pair can no longer
// close in (`separated`). Each advance aims at half the tolerance, never at contact, so that there is always
// a plane. The guarantee: for every t < toc the shapes are disjoint; it holds for any status but
// touching_at_start and penetrating_at_start, whose toc is 0. Mirtich (1996), section 2.3; Zhang, Lee, Kim
// (2006), section 4.
//
// Throws std::invalid_argument for a negative or non-finite interval, tolerance or motion.
AdvanceResult advance(const Convex& shape_a, const Motion& motion_a, const Convex& shape_b,
                      const Motion& motion_b, const AdvanceOptions& options);

// The same into a result that was used before: its vectors keep their storage, so that a loop of queries
// allocates nothing.
void advance(const Convex& shape_a, const Motion& motion_a, const Convex& shape_b, const Motion& motion_b,
             const AdvanceOptions& options, AdvanceResult& result);

}  // namespace fc::ca

// Exercise 1.9: conservative advancement, from nothing.
#pragma once

#include "ch01_convex_advancement/clear/answer.hpp"
#include "ch01_convex_advancement/clear/pieces.hpp"
#include "ch01_convex_advancement/gjk.hpp"  // rounding_term

namespace fc::mine {

using ca::clear::check_clear_query;
using ca::clear::mover;
using ca::clear::Pieces;
using ca::clear::report;
using ca::clear::status_at_start;
using ca::clear::witness;

// The first contact of two moving convex shapes in [0, options.interval].
//   pieces: ask pieces.gap (with pieces.closest_point) for gaps and pieces.speed_bound for speeds, so that whoever wrote them is
//     asked. clear/answer.hpp has what stands around the loop; use it:
//       check_clear_query()   first
//       mover()               a body as speed_bound wants it
//       report()              after each gap, whatever comes of it
//       status_at_start()     which of the two statuses at t = 0
//       witness()             for result.features, if the status is contact or touching_at_start
//
// At each time: tolerance = the larger one of options.tolerance and 8 rounding_term(); ask for the gap to an accuracy of
// tolerance / 8; then
//   upper <= tolerance                  `contact`, or at t = 0 what status_at_start() says
//   t is the interval's end             `separated`
//   options.max_iterations advances made, or lower <= tolerance / 2, or t can no longer grow     `unresolved`
// Otherwise advance for as long as the gap certainly stays above tolerance / 2, at most to the interval's end (then t is
// exactly options.interval), and count it in result.iterations. With options.certificate each advance is a row: t, n,
// gap_lower, a speed, and the advance. The speed is one that the pair certainly keeps to (that of speed_bound will do), and
// gap_lower - speed * advance >= 0.
// Guarantee: before result.toc the shapes are disjoint.
ca::AdvanceResult advance(const ca::Convex& a, const ca::Motion& motion_a, const ca::Convex& b,
                          const ca::Motion& motion_b, const ca::AdvanceOptions& options,
                          const Pieces& pieces);

}  // namespace fc::mine

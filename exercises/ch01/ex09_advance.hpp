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
//   pieces: take gaps from pieces.gap (with pieces.closest_point) and speeds from pieces.speed_bound, whoever wrote them.
//     clear/answer.hpp has the surroundings of the loop; use them:
//       check_clear_query()   first
//       mover()               a body in the form that speed_bound takes
//       report()              after each gap, whatever follows
//       status_at_start()     the status at t = 0: touching or penetrating
//       witness()             for result.features, if the status is contact or touching_at_start
//
// At each time: tolerance = the larger of options.tolerance and 8 rounding_term(); compute the gap to an accuracy of
// tolerance / 8; then
//   upper <= tolerance                  `contact`, or at t = 0 what status_at_start() says
//   t is the interval's end             `separated`
//   options.max_iterations advances made, or lower <= tolerance / 2, or t can no longer grow     `unresolved`
// Otherwise advance for as long as the gap certainly stays above tolerance / 2, at most to the interval's end (then t is
// exactly options.interval), and count it in result.iterations. With options.certificate each advance is a row: t, n,
// gap_lower, a speed, and the advance. The speed is one that the pair certainly does not exceed (that of speed_bound will
// do), and gap_lower - speed * advance >= 0.
// Guarantee: before result.toc the shapes are disjoint.
ca::AdvanceResult advance(const ca::Convex& a, const ca::Motion& motion_a, const ca::Convex& b,
                          const ca::Motion& motion_b, const ca::AdvanceOptions& options,
                          const Pieces& pieces);

}  // namespace fc::mine

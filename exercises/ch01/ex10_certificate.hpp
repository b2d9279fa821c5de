// Exercise 1.10: do these rows prove that nothing touched?
#pragma once

#include "ch01_convex_advancement/clear/pieces.hpp"
#include "ch01_convex_advancement/gjk.hpp"  // support_gap, rounding_term

namespace fc::mine {

// "" if the rows prove that the pair is clear from 0 to toc (s); else what is wrong, in a sentence that begins with "row 3: "
// if row 3 is wrong (rows count from 0).
//   rows: each claims that h seconds after row.t the gap along row.normal is at least gap_lower - speed_bound h, for every h
//     from 0 to row.advance. They may come from any bound, and may be false.
//   a, b: Convex::reach is that of the core; the radius does not add to it, since a ball stays round as it turns.
//   motions: constant acceleration and constant spin.
// ca::support_gap(a, b, PairPose(motion_a, motion_b, t), n) is the gap along n at t, less rounding_term(). Neither GJK nor
// speed_bound() is needed.
//
// What must hold: every normal has length 1; the first row starts at 0, each other one where the one before it ends, and the
// last one ends at toc; no row uses up more than its gap_lower; the gap is at least what the row claims, wherever you look;
// and you look so often that nothing can have touched between two looks. Numbers that should be equal may differ by 1e-12 of
// their size, a gap by rounding_term(). A NaN proves nothing. Without rows only toc = 0 is proved.
std::string check_certificate(const std::vector<ca::CertificateRow>& rows, const ca::Convex& a,
                              const ca::Motion& motion_a, const ca::Convex& b, const ca::Motion& motion_b,
                              double toc);

}  // namespace fc::mine

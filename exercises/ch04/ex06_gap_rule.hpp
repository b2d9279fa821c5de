// Exercise 4.6: at which gap is a pair stopped next?
#pragma once

#include "ch04_multibody_stepping/clear/pieces.hpp"

namespace fc::mine {

using world::clear::GapScale;
using world::clear::NextGap;

// The gap rule: how much of a pair's gap the search for its next contact may use up.
//   gap:   m, certified, from which the search starts; infinite: the pair is far apart, and the gap has not been measured.
//   scale: which gaps are far, too small, or possibly only rounding, all in m (clear/pieces.hpp).
//
// target: half of the gap; of a gap beyond scale.far, half of scale.far. A gap of at most scale.rounding cannot be halved, since
//         it may not be there at all: then the target is gap - scale.rounding (perhaps below 0).
// spent:  whether the gap is too small to be halved, or only rounding, so that a pair that still closes in must be frozen. The
//         limit counts: a gap of exactly scale.little is spent.
NextGap gap_rule(double gap, const GapScale& scale);

}  // namespace fc::mine

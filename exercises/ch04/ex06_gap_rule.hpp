// Exercise 4.6: at which gap is a pair stopped the next time?
#pragma once

#include "ch04_multibody_stepping/clear/pieces.hpp"

namespace fc::mine {

using world::clear::GapScale;
using world::clear::NextGap;

// The gap rule: what the search for a pair's next contact may use up of the pair's gap.
//   gap:   m, certified, from which the search starts; infinite: the pair is far, and nobody has measured how far.
//   scale: which gaps are far, little, or nothing but rounding, all in m (clear/pieces.hpp).
//
// target: half of the gap; of a gap beyond scale.far, half of scale.far. A gap of at most scale.rounding cannot be halved, for
//         nobody knows whether it is there: then the target is gap - scale.rounding (perhaps below 0).
// spent:  whether the gap is little or mere rounding, so that a pair that still closes in has to be frozen. At the limit it
//         is: a gap of just scale.little is little.
NextGap gap_rule(double gap, const GapScale& scale);

}  // namespace fc::mine

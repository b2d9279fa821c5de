#include <algorithm>

#include "ch04_multibody_stepping/clear/pieces.hpp"

namespace fc::world::clear {

// ANCHOR: gap_rule
NextGap gap_rule(double gap, const GapScale& scale) {
  NextGap next;
  // Half of what is left, and at most half of what counts as far: so no gap ever becomes zero.
  next.target = 0.5 * std::min(gap, scale.far);
  // A gap that may be rounding alone cannot be halved; the search may use up the rounding, no more.
  if (gap <= scale.rounding) next.target = gap - scale.rounding;
  next.spent = gap <= std::max(scale.little, scale.rounding);
  return next;
}
// ANCHOR_END: gap_rule

}  // namespace fc::world::clear

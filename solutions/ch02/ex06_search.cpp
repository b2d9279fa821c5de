// The book's: chapters/ch02_hull_hierarchy/clear/search.cpp.
#include "ex06_search.hpp"

namespace fc::mine {

FirstContact search(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                    const ca::Motion& motion_b, const SearchOptions& options,
                    const ca::clear::Pieces& pieces) {
  return hulls::clear::search(a, motion_a, b, motion_b, options, pieces);
}

}  // namespace fc::mine

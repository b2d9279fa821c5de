#include "ex06_search.hpp"

#include <queue>

#include "common/todo.hpp"

namespace fc::mine {

FirstContact search(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                    const ca::Motion& motion_b, const SearchOptions& options,
                    const ca::clear::Pieces& pieces) {
  FC_TODO("2.6");
}

}  // namespace fc::mine

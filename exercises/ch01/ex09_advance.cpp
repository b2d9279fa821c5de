#include "ex09_advance.hpp"

#include "common/todo.hpp"

namespace fc::mine {

ca::AdvanceResult advance(const ca::Convex& a, const ca::Motion& motion_a, const ca::Convex& b,
                          const ca::Motion& motion_b, const ca::AdvanceOptions& options,
                          const Pieces& pieces) {
  FC_TODO("1.9");
}

}  // namespace fc::mine

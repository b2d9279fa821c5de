#include "ex06_gap_rule.hpp"

#include "common/todo.hpp"

namespace fc::mine {

NextGap gap_rule(double gap, const GapScale& scale) {
  FC_TODO("4.6");
}

}  // namespace fc::mine

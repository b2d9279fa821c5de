#include "ch04_multibody_stepping/clear/pieces.hpp"

namespace fc::world::clear {

std::vector<PieceSlot> slots(Pieces& pieces) {
  return {slot("ch04/ex06_gap_rule", "the gap rule", pieces.gap_rule),
          slot("ch04/ex07_event_loop", "the loop of a step", pieces.event_loop)};
}

}  // namespace fc::world::clear

#include "ch06_friction/clear/pieces.hpp"

namespace fc::friction::clear {

std::vector<PieceSlot> slots(Pieces& pieces) {
  return {slot("ch06/ex01_one_contact", "one contact with friction", pieces.solve_contact)};
}

}  // namespace fc::friction::clear

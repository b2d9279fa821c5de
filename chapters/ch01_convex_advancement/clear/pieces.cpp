#include "ch01_convex_advancement/clear/pieces.hpp"

namespace fc::ca::clear {

std::vector<PieceSlot> slots(Pieces& pieces) {
  return {slot("ch01/ex06_closest_point", "the closest point of a simplex", pieces.closest_point),
          slot("ch01/ex07_gjk", "the gap of two shapes", pieces.gap),
          slot("ch01/ex08_speed_bound", "the bound of the closing speed", pieces.speed_bound),
          slot("ch01/ex09_advance", "the advancement", pieces.advance),
          slot("ch01/ex10_certificate", "the checker of certificates", pieces.check_certificate)};
}

}  // namespace fc::ca::clear

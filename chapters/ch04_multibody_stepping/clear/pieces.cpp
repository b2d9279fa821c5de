#include "ch04_multibody_stepping/clear/pieces.hpp"

namespace fc::world::clear {

std::vector<PieceSlot> slots(Pieces& pieces) {
  std::vector<PieceSlot> all = hulls::clear::slots(pieces.hulls);
  // Chapter 2's search replaces chapter 1's loop, and nothing here writes a certificate.
  std::erase_if(all, [](const PieceSlot& slot) {
    return slot.exercise == "ch01/ex09_advance" || slot.exercise == "ch01/ex10_certificate";
  });
  for (const PieceSlot& slot : lcp::clear::slots(pieces.lcp)) all.push_back(slot);
  all.push_back(slot("ch04/ex06_gap_rule", "the gap rule", pieces.gap_rule));
  all.push_back(slot("ch04/ex07_event_loop", "the loop of a step", pieces.event_loop));
  return all;
}

}  // namespace fc::world::clear

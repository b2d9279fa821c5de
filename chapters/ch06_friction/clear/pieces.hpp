// Chapter 6's piece: one contact. The clear law (law.hpp) calls it for every contact in every sweep.
#pragma once

#include "ch06_friction/clear/one_contact.hpp"
#include "common/pieces.hpp"

namespace fc::friction::clear {

struct Pieces {
  ContactFunction* solve_contact = clear::solve_contact;  // 6.1
};
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::friction::clear

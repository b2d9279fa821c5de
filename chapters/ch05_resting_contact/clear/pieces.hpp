// Chapter 5's step in its clear form runs on one piece, which is an exercise.
#pragma once

#include <vector>

#include "ch05_resting_contact/clear/resting_step.hpp"
#include "common/pieces.hpp"

namespace fc::resting::clear {

struct Pieces {
  LcpFunction solve_lcp;                                    // chapter 3's Dantzig
  RestingStepFunction* resting_step = clear::resting_step;  // 5.7
  Pieces();
};
// In the order of the exercises.
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::resting::clear

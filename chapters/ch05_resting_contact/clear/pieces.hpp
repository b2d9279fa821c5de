// Chapter 5's step in its clear form runs on its own piece and on chapter 3's, each of which is an exercise.
#pragma once

#include <vector>

#include "ch03_impulse_lcp/clear/pieces.hpp"
#include "ch05_resting_contact/clear/resting_step.hpp"
#include "common/pieces.hpp"

namespace fc::resting::clear {

struct Pieces {
  lcp::clear::Pieces lcp;                                   // 3.6
  RestingStepFunction* resting_step = clear::resting_step;  // 5.7

  // 3.6 as 5.7 is handed it. Its answers are checked: it finds what solves the problem, or nothing.
  LcpFunction solve_lcp() const;
};
// In the order of the exercises, the earlier chapter's first.
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::resting::clear

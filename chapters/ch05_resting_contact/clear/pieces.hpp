// Chapter 5's step in its clear form runs on a piece of its own, and on those of the chapters before.
#pragma once

#include <vector>

#include "ch04_multibody_stepping/clear/pieces.hpp"
#include "ch05_resting_contact/clear/resting_step.hpp"
#include "common/pieces.hpp"

namespace fc::resting::clear {

struct Pieces {
  world::clear::Pieces world;                               // chapter 4's, with those before
  RestingStepFunction* resting_step = clear::resting_step;  // 5.7

  // 3.6 as 5.7 is handed it. Its answers are checked: it finds what solves the problem, or nothing. Where it gives up,
  // without a proof that there is none, chapter 3's fast method is asked.
  LcpFunction solve_lcp() const;
};
// In the order of the exercises, the earlier chapters' first.
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::resting::clear

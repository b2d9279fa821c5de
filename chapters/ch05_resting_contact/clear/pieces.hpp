// Chapter 5's step in its clear form runs on a piece of its own, and on those of earlier chapters.
#pragma once

#include <vector>

#include "ch04_multibody_stepping/clear/pieces.hpp"
#include "ch05_resting_contact/clear/resting_step.hpp"
#include "common/pieces.hpp"

namespace fc::resting::clear {

struct Pieces {
  world::clear::Pieces world;                               // chapter 4's, with those before
  RestingStepFunction* resting_step = clear::resting_step;  // 5.7

  // Exercise 3.6, in the form in which 5.7 gets it. Its answers are checked: it returns a solution of the problem, or
  // none. Where it gives up without a proof that there is none, chapter 3's fast method is tried.
  LcpFunction solve_lcp() const;
};
// In the order of the exercises, the earlier chapters' first.
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::resting::clear

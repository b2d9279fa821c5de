// Exercise 5.5: the gaps of a column, corrected by the least motion.
#pragma once

#include <span>
#include <vector>

namespace fc::exercises {

struct Box {
  double mass = 1;  // kg, > 0
  double gap = 0;   // m, to what is below: the box before, or for the first box the floor
};

struct Correction {
  std::vector<double> displaced;  // d_i, m, upwards, of each box
  std::vector<double> pushes;     // y_i, kg m, >= 0, of each gap; exactly 0 where u_i > 0
  double energy = 0;              // J, potential energy that the displacements add
};

// Displacements that correct the gaps of a column; boxes and gaps are given from below. A gap g that lacks something to
// the rest gap h/2 (`width` h, m, > 0) has to grow by at least `share` (in (0, 1]) of that; a larger gap may shrink by
// all that it has above h/2:
//   r_i = share (h/2 - g_i)  if g_i < h/2,   h/2 - g_i  else;   u_i = d_i - d_(i-1) - r_i >= 0.
// The floor stays: d_(-1) = 0. Of all such displacements, those with the smallest sum of m_i d_i^2, which are the
// solution of
//   m_i d_i = y_i - y_(i+1),   y_i >= 0,   u_i >= 0,   y_i u_i = 0
// (nothing pushes above the last box). `floor` false: the column is in the air. Then there is no row 0: the first gap
// means nothing, y_0 = 0, and d_0 is free.
//
// Exact up to rounding, for up to 10^5 boxes: displacements to 1e-12 of the sum of all |r|, pushes to that times the
// mass of all boxes. (Sums of so many numbers need more digits than a double has.) The cost grows like the number of
// boxes. `gravity`: m/s^2, >= 0, downwards. The energy is never negative, and zero in the air.
Correction correct(std::span<const Box> boxes, bool floor, double width, double share, double gravity);

}  // namespace fc::exercises

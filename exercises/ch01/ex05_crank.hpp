// Exercise 1.5: a tighter bound that moves the plot.
#pragma once

#include "common/types.hpp"

namespace fc::exercises {

// A pin of some radius at the end of an arm that turns evenly in a vertical plane, under a ceiling. At time t
// its gap to the ceiling is
//   gap(t) = clearance - arm sin(angle + spin t),
// where `clearance` is the ceiling's height above the arm's axle, less the pin's radius.
struct Crank {
  double arm = 0;        // m, > 0
  double clearance = 0;  // m
  double angle = 0;      // rad, at t = 0
  double spin = 0;       // rad/s, of either sign, or zero
};

double gap(const Crank& crank, double t);  // m; given

// For how many seconds h after t the gap certainly stays at or above `target` (m): for all of them, not only
// at the end. Infinity if it does for ever, that is, if the pin never comes so high or does not move. The gap
// at t is above the target. (A gap is what gap() says: some 1e-15 of clearance + arm (1 + |angle| + |spin| t)
// from the exact one, and so is what may be missing from the target.)
//
// At least as long as both  (gap - target) / (arm |spin|)  and the time in which
//   gap - c h - k h^2,   c the closing speed at t,   k = arm spin^2 / 2,
// comes down to the target; and exact to 12 digits of that, however small the room (gap - target) is, and
// however slowly the pin turns. (Of c with the angle at t that a double has.)
double safe_step(const Crank& crank, double t, double target);

}  // namespace fc::exercises

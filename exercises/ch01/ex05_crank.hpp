// Exercise 1.5: a tighter bound that moves the plot.
#pragma once

#include "common/types.hpp"

namespace fc::exercises {

// A round pin at the end of an arm that turns at a constant rate in a vertical plane, under a ceiling. At
// time t its gap to the ceiling is
//   gap(t) = clearance - arm sin(angle + spin t),
// where `clearance` is the ceiling's height above the arm's axle, less the pin's radius.
struct Crank {
  double arm = 0;        // m, > 0
  double clearance = 0;  // m
  double angle = 0;      // rad, at t = 0
  double spin = 0;       // rad/s, of either sign, or zero
};

double gap(const Crank& crank, double t);  // m; given

// For how many seconds h after t the gap certainly stays at or above `target` (m), all the time and not only
// at the end. Infinity if it does for ever, that is, if the pin never comes that high or does not move. The
// gap at t is above the target. (A gap is the value of gap(), about 1e-15 of clearance + arm (1 + |angle| +
// |spin| t) from the exact one; by as much it may fall short of the target.)
//
// At least as long as both  (gap - target) / (arm |spin|)  and the time in which
//   gap - c h - k h^2,   c the closing speed at t,   k = arm spin^2 / 2,
// comes down to the target, up to 1e-12 of these times, however small the room (gap - target) is, and however
// slowly the pin turns. (For c, the angle at t is the one that a double holds.)
double safe_step(const Crank& crank, double t, double target);

}  // namespace fc::exercises

// Exercise 4.1: beyond Zeno: a bouncing ball at any time, also after infinitely many bounces.
#pragma once

#include <cstdint>

namespace fc::exercises {

// A ball above a floor, at t = 0.
struct Drop {
  double height = 0;       // m, >= 0, of its lowest point above the floor
  double velocity = 0;     // m/s, upwards; negative: thrown down
  double restitution = 0;  // epsilon, in [0, 1]
  double gravity = 9.81;   // m/s^2, > 0
};

struct BallState {
  double height = 0;         // m
  double velocity = 0;       // m/s, upwards; just after the bounce at the time of one, and 0 at rest
  std::int64_t bounces = 0;  // so far; where the ball is at rest: -1, for there were infinitely many
  bool at_rest = false;      // for good
};

// The ball at time t (s, >= 0), in closed form: the cost does not grow with the number of bounces. For
// heights and speeds of the order of one and up to 10^5 bounces the height is exact to 1e-9 m; also in the
// last instants before the ball comes to rest there is an answer, and bounces are never taken back. The first
// touch comes when it should to 1e-12 of its time, however hard the ball is thrown. Bounces are counted up to
// 10^18, and remain that; of the height nothing is left then. With
// restitution 0 the ball is at rest from its first touch on (that is no infinity: but -1 all the same); with
// 1 it never is. A ball that starts on the floor and not upwards is at rest at once, unless it is thrown down
// and bounces.
BallState ball_at(const Drop& drop, double t);

}  // namespace fc::exercises

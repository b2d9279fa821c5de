// Exercise 4.1: beyond Zeno: a bouncing ball at any time, even after infinitely many bounces.
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
  double velocity = 0;       // m/s, upwards; at the time of a bounce just after it, and 0 at rest
  std::int64_t bounces = 0;  // so far; -1 when the ball is at rest, since there were infinitely many
  bool at_rest = false;      // for good
};

// The ball at time t (s, >= 0), in closed form: the cost does not grow with the number of bounces. For heights and
// speeds of the order of one and up to 10^5 bounces the height is exact to 1e-9 m. There is an answer even in the last
// instants before the ball comes to rest, and the number of bounces never falls. The time of the first touch is right
// to 1e-12 of itself, however hard the ball is thrown. Bounces are counted up to 10^18, and the count then stays there;
// by then the height has no digits left. With restitution 0 the ball is at rest from its first touch on (not after
// infinitely many bounces, but -1 all the same); with 1 it never comes to rest. A ball that starts on the floor without
// moving upwards is at rest at once, unless it is thrown down and bounces.
BallState ball_at(const Drop& drop, double t);

}  // namespace fc::exercises

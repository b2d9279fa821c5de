// Exercise 5.2: how wide an envelope may be, and how many bounces of a ball it leaves.
#pragma once

#include <cstdint>

namespace fc::exercises {

// A ball that is dropped onto a floor. With u = sqrt(2 g height), its touch k = 0, 1, ... has the speed u e^k, and
// between the touches k and k + 1 lie 2 u e^(k+1) / g seconds. The envelope's width is negligible beside the height,
// and is left out here.
struct Drop {
  double height = 1;       // m, > 0
  double restitution = 0;  // e, in [0, 1]
  double gravity = 9.81;   // m/s^2, > 0
};

struct Ending {
  std::int64_t bounces = 0;  // touches faster than h/dt, which bounce: events. -1: infinitely many
  double time = 0;           // s, from the drop to the touch that is stopped; infinite if none
  double cut = 0;            // s, for which the ball would have gone on bouncing after that touch
  double energy = 0;         // J per kg, of this touch, which are lost
};

// How an envelope of this width (m, > 0) ends the bounces in frames of dt seconds (> 0): the first touch that is not
// faster than h/dt is the last; from then on the ball rests. Relative errors below 1e-12, also for 1 - e = 1e-9, and
// without going from bounce to bounce. A touch whose speed is h/dt up to rounding (1e-12) may count either way; if the
// speed is exact, as with e = 1/2, it does not bounce.
Ending ending(const Drop& drop, double width, double dt);

// The widest envelope, m, with which no ball under this gravity, whatever its height, loses more than one
// frame of bouncing: `cut` is at most dt. Infinite if e = 0; 0 if e = 1.
double widest_envelope(double restitution, double gravity, double dt);

// The narrowest envelope, m, that leaves this drop at most this number of bounces (>= 0).
double narrowest_envelope(const Drop& drop, double dt, std::int64_t bounces);

// The shortest frame, s, for which the widest envelope is at least `least` (m, > 0; the chapter asks for a hundred
// tolerances). 0 if e = 0; infinite if e = 1.
double shortest_frame(double restitution, double gravity, double least);

}  // namespace fc::exercises

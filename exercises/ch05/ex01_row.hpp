// Exercise 5.1: a plan of one contact: half of gravity, a push, a correction of the gap without any velocity, the other
// half of gravity, and the instant at the plan's end.
#pragma once

namespace fc::exercises {

// The envelope, and the frame's length. Here a plan lasts one frame.
struct Envelope {
  double width = 0;     // h, m, > 0
  double dt = 0;        // s, > 0: the frame's length
  double share = 0.2;   // in (0, 1]: the share of a gap's lack (to h/2) that a plan makes up
  double least = 0.25;  // in [0, 1/2]: the part of h that the gap reaches at once
};

// A ball above a floor.
struct Ball {
  double mass = 1;         // kg, > 0
  double gap = 0;          // m, >= 0
  double velocity = 0;     // m/s, upwards
  double restitution = 0;  // in [0, 1]
};

// Whether the ball's contact is an impact at this instant, and so may bounce: it closes in faster than h/dt, its gap is
// at most the rest gap h/2, and it does not `last`: no plan that ends now has pushed at it.
bool is_impact(const Envelope& envelope, const Ball& ball, bool lasts);

// How fast a row with this gap (m) may close in, m/s, never negative: w >= -approach_limit. A gap above h/2 may shrink
// to h/2 by the plan's end; a smaller gap may not shrink.
double approach_limit(const Envelope& envelope, double gap);

// By how much displacement widens a gap (m) to which the plan's velocities lead, m, never negative: by nothing from h/2
// on; below, by a `share` of what it lacks to h/2, or by all that it lacks to `least` h, whichever is more.
double displacement(const Envelope& envelope, double gap);

struct Frame {
  double push = 0;       // N s, >= 0, from the floor, during the plan
  double stop = 0;       // N s, >= 0, from the floor, at the instant at the plan's end
  double displaced = 0;  // m, >= 0
  double energy = 0;     // J, potential energy that the displacement added
};

// One frame of a ball that is in contact (gap <= h) and follows a plan:
//   1. half of gravity (m/s^2, >= 0) first: u = v - dt gravity / 2;
//   2. push: w is the smallest velocity >= u that the row allows, and the ball moves straight on with it for the frame;
//   3. correct: then the gap is corrected, which changes no velocity;
//   4. the other half of gravity;
//   5. the instant: if the ball is still in contact and closes in, an impact leaves with `restitution` times its speed. A contact
//      that closes in faster than h/dt, did not last, and has a gap above h/2 is left alone: it will be an event later. All
//      others are stopped.
// Guarantees, up to rounding: the gap never falls below h/2, or below its value at the start if that was less; a ball
// that is not pushed moves as in free fall; kinetic and potential energy together grow by at most `energy`.
Frame rest(const Envelope& envelope, double gravity, Ball& ball);

}  // namespace fc::exercises

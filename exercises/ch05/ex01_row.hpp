// Exercise 5.1: a plan of one contact: half of gravity, a push, a gap put right without any velocity, the other half of gravity,
// and the instant at the plan's end.
#pragma once

namespace fc::exercises {

// The envelope, and the frame's length. A plan is as long as the frame here.
struct Envelope {
  double width = 0;     // h, m, > 0
  double dt = 0;        // s, > 0: the frame's length
  double share = 0.2;   // in (0, 1]: the part of what a gap lacks to h/2 that a plan makes up
  double least = 0.25;  // in [0, 1/2]: what lacks to this part of h is made up at once
};

// A ball above a floor.
struct Ball {
  double mass = 1;         // kg, > 0
  double gap = 0;          // m, >= 0
  double velocity = 0;     // m/s, upwards
  double restitution = 0;  // in [0, 1]
};

// Whether the ball's contact is an impact at this instant, and so may bounce: it closes in faster than h/dt, is not farther away
// than the rest gap h/2, and is not one that `lasts`: at which a plan that ends now has pushed.
bool is_impact(const Envelope& envelope, const Ball& ball, bool lasts);

// How fast a row with this gap (m) may close in, m/s, never negative: w >= -approach_limit. What is farther away than h/2
// may come in to h/2 by the plan's end; what is nearer may not come nearer.
double approach_limit(const Envelope& envelope, double gap);

// By how much a gap (m) that the plan's velocities lead to is widened by displacement, m, never negative: nothing from h/2 on;
// below, a `share` of what lacks to h/2, or all that lacks to `least` h, whichever is more.
double displacement(const Envelope& envelope, double gap);

struct Frame {
  double push = 0;       // N s, >= 0, that the floor gives in the plan
  double stop = 0;       // N s, >= 0, and at the instant at its end
  double displaced = 0;  // m, >= 0
  double energy = 0;     // J, potential energy that the displacement added
};

// One frame of a ball that is in contact (gap <= h) and goes by a plan:
//   1. half of gravity (m/s^2, >= 0) first: u = v - dt gravity / 2;
//   2. push: w is the smallest velocity >= u that the row allows, and with it the ball moves straight on for the frame;
//   3. correct: then the gap is put right, which changes no velocity;
//   4. the other half of gravity;
//   5. the instant: if the ball is still in contact and closes in, an impact leaves with `restitution` times its speed. What closes
//      in faster than h/dt, did not last, and is farther away than h/2 is left alone: it is not there yet. All else is stopped.
// Guarantees, up to rounding: the gap never comes below h/2, or below what it was if that was less; what is not pushed moves as in
// free fall; kinetic and potential energy together grow by `energy` at most.
Frame rest(const Envelope& envelope, double gravity, Ball& ball);

}  // namespace fc::exercises

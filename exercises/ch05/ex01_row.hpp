// Exercise 5.1: the right-hand side of a row: how fast a contact in the envelope may close in, and how its
// gap is put right without any velocity.
#pragma once

namespace fc::exercises {

// The envelope, and the frame in which it is asked.
struct Envelope {
  double width = 0;     // h, m, > 0
  double dt = 0;        // s, > 0: the frame's length
  double share = 0.2;   // in (0, 1]: of what a gap lacks to h/2, so much is made up in a frame
  double least = 0.25;  // in [0, 1/2]: what lacks to this part of h is made up at once
};

// A ball above a floor.
struct Ball {
  double mass = 1;         // kg, > 0
  double gap = 0;          // m, >= 0, at the frame's start
  double velocity = 0;     // m/s, upwards, at the frame's start: this frame's gravity is not in it
  double restitution = 0;  // in [0, 1]
};

// Whether the contact is an impact, and chapter 4's: it bounces at all, and closes in both faster than h/dt
// and so fast that it comes below h/2 within the frame. All others are rows.
bool is_impact(const Envelope& envelope, const Ball& ball);

// How fast a row with this gap (m) may close in, m/s, never negative: v >= -allowed. What is farther away
// than h/2 may come in to h/2 by the frame's end; what is nearer may not come nearer.
double allowed(const Envelope& envelope, double gap);

// By how much a gap (m) that the frame's velocities lead to is widened by displacement, m, never negative:
// nothing from h/2 on; below, a `share` of what lacks to h/2, or all that lacks to `least` h, whichever is
// more.
double displacement(const Envelope& envelope, double gap);

struct Frame {
  double impulse = 0;    // N s, >= 0, that the floor gave
  double displaced = 0;  // m, >= 0
  double energy = 0;     // J, potential energy that the displacement added
};

// One frame of a ball that is a row: with v* = v - dt gravity (m/s^2, >= 0) its new velocity is the smallest
// v+ >= v* that the row allows, and with it the ball moves straight on for the frame. Then the gap is put
// right; the velocity does not hear of that. Guarantees, up to rounding: the gap never comes below h/2, or
// below what it was if that was less; the impulse is 0 unless the row is at its bound; kinetic and potential
// energy together grow by `energy` at most.
Frame rest(const Envelope& envelope, double gravity, Ball& ball);

}  // namespace fc::exercises

// Exercise 5.6: why does it hop?
#pragma once

#include <vector>

namespace fc::exercises {

// A box that can only move up and down.
struct Box {
  double mass = 1;         // kg, > 0
  double height = 1;       // m, > 0
  double bottom = 0;       // m, of its lower face, above the floor
  double velocity = 0;     // m/s, upwards
  double restitution = 0;  // in [0, 1], of the contact below it
};

// Boxes one above the other over a floor that nothing moves.
struct Pile {
  std::vector<Box> boxes;  // from below upwards; no gap is negative; masses within a factor of 10^3
  double gravity = 9.81;   // m/s^2, >= 0, downwards
  double envelope = 1e-3;  // h, m, > 0: what has a gap of at most h is in contact
};

// The gap below a box (a number in `boxes`), m: to the box under it, or to the floor.
double gap_below(const Pile& pile, int box);

// What a contact gave: this box upwards, and as much downwards to the box under it, if there is one.
struct Impulse {
  int box = 0;
  double amount = 0;  // N s, > 0
  double time = 0;    // s in the frame: when it acted; of a plan's push, when the plan began
  double gap = 0;     // m, below the box while it acted; of a plan's push the wider one of both ends
};

struct Report {
  std::vector<Impulse> impulses;
  double lifted = 0;  // J, potential energy that corrections added
  int cut = 0;        // plans that ended before the frame did, since two boxes met
};

// One frame of dt seconds (> 0), by plans as in the chapter. It begins with an instant, and then has a plan:
// all boxes that are in contact go by it, and the others fly. The plan is made for the rest of the frame. It is
// cut if two boxes meet before, or a box and the floor: their gap was above h, and has come down to h/4. Where
// a plan ends there is an instant, and then the next plan, or the frame's end.
//
// A plan of T seconds. With half of gravity the velocities v become u; a push makes w of u. A gap at which it
// pushes ends at min(gap, h/2), and no gap in contact ends lower than that. Paths are straight, with w and a
// correction: a gap below h/2 ends wider by at least a fifth of what it lacks to h/2, and at h/4 or more.
// Velocities change evenly from v to w and the other half of gravity.
//
// An instant. Afterwards nothing in contact closes. First what a plan has just pushed is stopped, without
// bounce. Then all that closes is stopped, in each island: boxes that are in contact, directly or over others.
// If any contact of the island comes in faster than h/dt, of those that a plan has not just pushed, then all
// of them bounce, by Poisson's two stages with the chapter's cap on energy.
//
// Promised, up to rounding, for each frame:
//   Newton     each box: mass times the change of velocity is its weight times -dt, and all its impulses.
//   Reach      no impulse acts across a gap above h. What has nothing within h falls freely until it meets
//              something. A frame without impulses, cuts and corrections ends as free fall does.
//   Energy     kinetic and potential energy together grow by `lifted` at most.
//   Rest       corrections change places, never velocities. What rests at h/2 stays there; also if something
//              hits it, and all restitutions are the same: it does not hop.
//   Gaps       no gap ends below what it was, or below h/4 if that is less.
//   Time       all of dt passes for each box.
Report step(Pile& pile, double dt);

}  // namespace fc::exercises

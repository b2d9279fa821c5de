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

// Boxes one above the other over a fixed floor.
struct Pile {
  std::vector<Box> boxes;  // from below upwards; no gap is negative; masses within a factor of 10^3
  double gravity = 9.81;   // m/s^2, >= 0, downwards
  double envelope = 1e-3;  // h, m, > 0: gaps of at most h are contacts
};

// The gap below a box (a number in `boxes`), m: to the box under it, or to the floor.
double gap_below(const Pile& pile, int box);

// The impulse of a contact: upwards on this box, and downwards on the box below, if there is one.
struct Impulse {
  int box = 0;
  double amount = 0;  // N s, > 0
  double time = 0;    // s in the frame: when it acted; for a plan's push, when the plan began
  double gap = 0;     // m, below the box while it acted; for a plan's push the wider of the gaps at both ends
};

struct Report {
  std::vector<Impulse> impulses;
  double lifted = 0;  // J, potential energy that corrections added
  int cut = 0;        // plans that ended before the frame, since two boxes met
};

// One frame of dt seconds (> 0), by plans as in the chapter. It begins with an instant, and then has a plan, which all
// boxes in contact follow, while the others fly. The plan is made for the rest of the frame. It is cut short if two
// boxes, or a box and the floor, meet before its end: their gap was above h, and has come down to h/4. Where a plan
// ends there is an instant, and then the next plan, or the frame's end.
//
// A plan of T seconds. With half of gravity the velocities v become u; a push turns u into w. A gap at which it pushes
// ends at min(gap, h/2), and no gap in contact ends below that. Paths are straight, with w and a correction: a gap
// below h/2 ends wider by at least a fifth of what it lacks to h/2, and at h/4 or more. Velocities change evenly from v
// to w and the other half of gravity.
//
// An instant. Afterwards no gap in contact closes. First the contacts at which a plan has just pushed are stopped,
// without bounce. Then all that closes is stopped, in each island: boxes in contact, directly or through others. If any
// contact of the island closes in faster than h/dt, apart from those at which a plan has just pushed, then all of these
// others bounce, by Poisson's two stages with the chapter's cap on energy.
//
// Promised, up to rounding, for each frame:
//   Newton     each box: mass times the change of velocity is its weight times -dt, and all its impulses.
//   Reach      no impulse acts across a gap above h. A box with nothing within h falls freely until it meets something. A
//              frame without impulses, cuts and corrections ends as free fall does.
//   Energy     kinetic and potential energy together grow by at most `lifted`.
//   Rest       corrections change places, never velocities. What rests at h/2 stays there, even if something hits it, if all
//              restitutions are equal: it does not hop.
//   Gaps       no gap ends below its value at the start, or below h/4 if that is less.
//   Time       all of dt passes for each box.
Report step(Pile& pile, double dt);

}  // namespace fc::exercises

// Exercise 6.5: why does it creep?
#pragma once

#include <vector>

#include "common/types.hpp"

namespace fc::exercises {

// A point of the body that may touch the floor.
struct Foot {
  Vec3 place = Vec3::Zero();  // m, from the body's centre, in the body's axes
  // What the step remembers from frame to frame; a new foot has no memory.
  bool touches = false;         // it was in contact in the last plan
  Mat3 axes = Mat3::Zero();     // normal, tangent 1, tangent 2: columns, in the world's axes
  Vec3 impulse = Vec3::Zero();  // N s, in the world's axes: its impulse in the last plan
};

// A rigid body with the same inertia about any axis, as cubes and balls have.
struct Body {
  double mass = 1;               // kg, > 0
  double inertia = 1;            // kg m^2, > 0, about any axis through the centre
  Vec3 centre = Vec3::Zero();    // m
  Mat3 turn = Mat3::Identity();  // from the body's axes to the world's
  Vec3 velocity = Vec3::Zero();  // m/s, of the centre
  Vec3 spin = Vec3::Zero();      // rad/s, in the world's axes
  std::vector<Foot> feet;
};

// A plane through the origin. It may be turned between two frames.
struct Floor {
  Vec3 normal{0, 0, 1};    // of length 1, to where the body is
  double friction = 0.5;   // >= 0
  double restitution = 0;  // in [0, 1]
};

struct Scene {
  Body body;
  Floor floor;
  Vec3 gravity{0, 0, -9.81};  // m/s^2
  double margin = 1e-3;       // h, m, > 0
};

// For a foot, with the body where it is: its place (m), its velocity (m/s), its gap (m).
Vec3 place_of(const Body& body, int foot);
Vec3 velocity_of(const Body& body, int foot);
double gap_of(const Scene& scene, int foot);

// An impulse of the floor on a foot.
struct Push {
  int foot = 0;
  Vec3 impulse = Vec3::Zero();  // N s, in the world's axes
  bool impact = false;          // from the impact; else from the plan
};

struct Report {
  std::vector<Push> pushes;
  double lifted = 0;  // J, potential energy that corrections added
};

// One frame of dt seconds (> 0): an impact, if there is one, and then a plan. In both, the feet in contact are those
// that have a gap of at most h, or that would pass through the floor in the frame. All arms are those of the frame's
// start.
//
// Impact. There is one only if a foot in contact closes in faster than h/dt. It has two stages. After the first, no
// foot closes in, and each obeys Coulomb's law. Then each foot gets the restitution's share of its normal impulse once
// more, and friction of at most mu times that, against the slip that is left. The second stage is reduced for all feet
// alike if it would cost more energy than the first one has taken (the chapter's cap).
//
// Plan. Velocities get all of gravity at once. A foot may close in with (gap - h/2)/dt, and with 0 if that is negative.
// Impulses obey Coulomb's law with this limit in place of 0, for the velocities at the plan's end. With these the body
// moves. A gap below h/2 is then widened, by a fifth of what it lacks, by a displacement that changes no velocity. A
// foot that sticks (its push is inside the cone) is not displaced along the floor.
//
// Promised for friction of at most 1, Newton to 1e-9 of what is added up, the rest to 1e-4:
//   Newton     m dv and I dw are what gravity and the pushes give.
//   Coulomb    a push does not pull; its tangential part is at most mu times its normal part. A foot that slips after the plan
//              is at that limit, directly against its slip. A foot below the limit sticks: it has no slip.
//   Energy     kinetic and potential energy together grow by at most `lifted`.
//   Places     a foot that sticks stays where it is on the floor (except for the effect of a turn of finite size).
//   Axes       a scene that is turned as a whole, between any two frames, goes on turned as a whole.
Report step(Scene& scene, double dt);

}  // namespace fc::exercises

// How long two convex nodes are safe from each other: the motion bounds of the hierarchical search.
#pragma once

#include "ch01_convex_advancement/gjk.hpp"
#include "ch01_convex_advancement/motion_bound.hpp"

namespace fc::hulls {

struct SafeStep {
  double time = 0;   // s, may be infinite
  double speed = 0;  // m/s, no pair of points closes in faster along n during that time, on average
};

// Two balls around the nodes' middles (radius_a, radius_b about a.center, b.center; m) that hold the nodes,
// with a gap that may shrink by `room` along n (unit, world, A to B), at time t of a motion that goes on
// until `end`. A point at r from the middle c moves along n with n.(v + w x c) + (n x w).r: the middle's
// exact speed, and at most |n x w| radius more; as the body turns, that changes by at most |n x w| |w x c|
// per second.
SafeStep ball_step(const ca::Motion& a, const ca::Convex& node_a, double radius_a, const ca::Motion& b,
                   const ca::Convex& node_b, double radius_b, const ca::PairPose& pose, const Vec3& n,
                   double t, double end, double room);

// Chapter 1's bound of whole bodies, about their centres of mass: how long until `room` could be used up
// along n. It does not grow with time, so it may be infinite.
double whole_step(const ca::Motion& a, const ca::Convex& shape_a, const ca::Motion& b,
                  const ca::Convex& shape_b, const Vec3& n, double t, double end, double room);

// In all three, if the spin changes (torque-free, or decaying), |n x w| means the most that it can be from
// now on, |n x w(t)| + wander, and a point at r accelerates by |dw/dt| |r| more; ca::Motion has both.

// Uses the points' own velocities. Along n (unit, world, A to B) the pair has `room` (m) more than it must
// keep, at time t of a motion that goes on until `end` (s). A point x of a body moves along n by h (n.v + (n
// x w).x), and at most h^2/2 |n x w| |w x x| more, so after h seconds the one with the largest (n + h n x
// w).x is ahead, up to that. The remaining room is concave in h: if some is left after h seconds, some is
// left at every time in between. Exact in each point's velocity, so a pair that parts, or slides along a
// face, gets long steps. Cost: two or three passes over the points.
SafeStep points_step(const ca::Motion& a, const ca::Convex& shape_a, const ca::Motion& b,
                     const ca::Convex& shape_b, const ca::PairPose& pose, const Vec3& n, double t, double end,
                     double room);

}  // namespace fc::hulls

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

// A plane of normal n that moves with the mean speed of the two support points, and half of `room` for either
// side: the first time at which a vertex could use up its half. Exact in each vertex's velocity, so a pair
// that parts, or slides along a face, is not held up. Cost: one pass over the vertices.
SafeStep plane_step(const ca::Motion& a, const ca::Convex& node_a, const ca::Motion& b,
                    const ca::Convex& node_b, const ca::PairPose& pose, const Vec3& n, double t, double room);

}  // namespace fc::hulls

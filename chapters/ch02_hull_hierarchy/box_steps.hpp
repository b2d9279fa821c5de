// How long four boxes of one body are safe from one box of the other: gap and motion bound in four lanes.
#pragma once

#include "ch01_convex_advancement/motion.hpp"
#include "ch02_hull_hierarchy/box_tree.hpp"

namespace fc::hulls {

using Vec3f = Eigen::Vector3f;
using Mat3f = Eigen::Matrix3f;

// The pair of bodies at one time, seen from the one whose node is opened; the other one's box stays whole.
// All in the opened body's axes, from its centre of mass.
struct OpenedView {
  Mat3 rotation;             // world to the opened body's axes
  Mat3 other_axes;           // the other body's axes to these
  Vec3 other_place;          // m, the other body's centre of mass
  Vec3f spin, other_spin;    // rad/s
  Vec3f velocity;            // m/s, of the opened body less that of the other
  Vec3f acceleration;        // m/s^2, the same
  float reach, other_reach;  // m
  // For spins that change: how much |n x w| may grow, rad/s, and the largest |dw/dt|, rad/s^2 (ca::Motion).
  float wander = 0, other_wander = 0, spin_change = 0, other_spin_change = 0;
};

// The views from both bodies at one pose: at time t of two motions, or of bodies at rest.
struct PairViews {
  OpenedView a, b;
};
PairViews views_at_rest(const ca::PairPose& pose);
PairViews views_of(const ca::PairPose& pose, const ca::Motion& motion_a, double reach_a,
                   const ca::Motion& motion_b, double reach_b, double t);

// What all steps of a query have in common.
struct StepLimits {
  float target;     // m, the gap that must be left, rounding radii included
  float keep;       // m, a pair with a gap of at most this is not advanced (>= target)
  float remaining;  // s, until the end of the interval
};

// For each lane: how long the box is proved to keep the target gap, and along which normal.
struct BoxSteps {
  Lanes time;     // s; 0: not at all; infinity: for ever
  Lanes gap;      // m, along the normal, certified
  Lanes3 normal;  // about unit, from the opened body to the other, opened body's axes
};

// Two normals are tried for each box, and the one with the longer step is kept: `hint` (opened body's axes,
// in the same direction), and the line between two points near each other, found by alternating projection.
//
//   gap     n.(c_Y - c_X) - sum |n.u_i| half_i of both boxes, less what float arithmetic can be wrong by
//   step    the largest h with  gap - b h - k h^2 >= target,
//           b = n.(v_X - v_Y) + n.(w_X x c_X) - n.(w_Y x c_Y) + |n x w_X| r_X + |n x w_Y| r_Y,
//           k = (|n x w_X| |w_X x c_X| + |n x w_Y| |w_Y x c_Y| + max(0, n.(a_X - a_Y))) / 2
//           (c: the boxes' centres from the centres of mass, r: their radii), or chapter 1's directional
//           bound of the whole bodies, whichever is longer.
//
// Proof: a point at c + s, |s| <= r, moves along n with n.v + (n x w).c + (n x w).s. The first two are exact
// now, and since c turns with the body their rate is at most |n.(w x (w x c))| = |(n x w).(w x c)|; the last
// is at most |n x w| r at any time.
BoxSteps box_steps(const BoxQuad& boxes, const BoxTree& other_tree, NodeId other, const OpenedView& view,
                   const Vec3f& hint, const StepLimits& limits);

}  // namespace fc::hulls

// How long two moving convex bodies stay apart along a plane's normal: the motion bounds.
#pragma once

#include <string>

#include "ch01_convex_advancement/convex.hpp"
#include "ch01_convex_advancement/motion.hpp"

namespace fc::ca {

// In this order each is at least as good as the one before. See the chapter's text for the proofs.
enum class MotionBound { naive, directional, projected, second_order };

// A step may end below the target by this share of it: to end exactly there would take more searching.
constexpr double kStepSlack = 0.25;

// Throws std::invalid_argument for another name.
MotionBound motion_bound_named(const std::string& name);

// Two moving bodies, seen as a pair. What does not change during a query is computed once.
class MovingPair {
 public:
  MovingPair(MotionBound bound, const Convex& a, const Motion& motion_a, const Convex& b,
             const Motion& motion_b);

  // An upper bound, in m/s, of n.(velocity of any point of A - velocity of any point of B) from time t (s)
  // until time `end`, where n (unit, world) points from A to B and does not move:
  //
  //   naive         n.(v_A - v_B) + |w_A| R_A + |w_B| R_B               R: the reach about the centre of mass
  //   directional   n.(v_A - v_B) + |n x w_A| R_A + |n x w_B| R_B       since n.(w x r) = (n x w).r
  //   projected     the same with the reach about the axis of the spin: only the part of r across it counts
  //
  // For a body that turns freely, |w| and |n x w| mean their largest values, and R the reach about the centre
  // of mass.
  //
  // A result <= 0 proves that the pair does not close along n until `end`. An acceleration changes
  // n.(v_A - v_B) linearly, so its larger end counts; equal accelerations cancel. A rounding radius moves
  // with the centre of its ball and adds nothing. Mirtich (1996); Zhang, Lee, Kim, "Interactive Continuous
  // Collision Detection for Non-Convex Polyhedra" (2006), section 4.
  double closing_speed_bound(const Vec3& n, double t, double end) const;

  // For how many seconds h from t on the gap along n certainly stays on or above a straight line: from `gap`
  // at t (m, certified, > target; the pose is given) to (1 - kStepSlack) target (m, > 0) at t + h. Infinity:
  // it stays above the latter until `end`. Besides the speed bound (gap - target) / speed, second_order tries
  //
  //   along n a point r of a body moves by  h n.(v + w x r)  and at most  h^2/2 |n x w| |w| across(r)  more
  //   (if it turns freely: h^2/2 (|n x w| |w| + |dw/dt|) |r|, the largest values),
  //
  // for all points at once: n.(w x r) = (n x w).r, so the support mapping in the turned direction
  // n + h (n x w) tells which point is ahead after h seconds. The remaining gap is then concave in h: if it
  // suffices now and after h seconds, it does in between.
  double safe_time(const PairPose& pose, const Vec3& n, double gap, double target, double t,
                   double end) const;

 private:
  // One body of the pair.
  struct Side {
    const Convex& shape;
    const Motion& motion;
    double reach;  // about the axis of the spin, if the bound uses that
  };
  double second_order_time(const PairPose& pose, const Vec3& n, double target, double t,
                           double remaining) const;

  MotionBound bound_;
  Side a_, b_;
};

// The smallest h > 0 (s) with  c h + k h^2 = room,  or infinity: how long something that starts with closing
// speed c (m/s) and bends by at most k (m/s^2) needs to cross `room` (m, >= 0).
double crossing_time(double c, double k, double room);

}  // namespace fc::ca

// Bounds on how fast two moving bodies can close in along a direction.
#pragma once

#include <algorithm>
#include <limits>
#include <string>

#include "ch01_convex_advancement/motion.hpp"

namespace fc::ca {

enum class MotionBound { naive, directional };

// Throws std::invalid_argument for another name.
MotionBound motion_bound_named(const std::string& name);

// An upper bound, in m/s, of n.(velocity of any point of A - velocity of any point of B) from time t (s)
// until time `end`, where n (unit, world) points from A to B and does not move. reach_a, reach_b (m) are the
// largest distances of the cores from their centres of mass: a rounding radius moves with the centre of its
// ball and adds nothing.
//
//   directional   n.(v_A - v_B) + |n x w_A| reach_a + |n x w_B| reach_b     since n.(w x r) = (n x w).r
//   naive         n.(v_A - v_B) + |w_A| reach_a + |w_B| reach_b
//
// A result <= 0 proves that the pair does not close along n until `end`. An acceleration changes n.(v_A -
// v_B) linearly, so its larger end counts; equal accelerations cancel. The last term covers the rounding of
// this sum itself. Zhang, Lee, Kim, "Interactive Continuous Collision Detection for Non-Convex Polyhedra"
// (2006), section 4; Mirtich (1996).
inline double closing_speed_bound(MotionBound kind, const Motion& a, const Motion& b, const Vec3& n, double t,
                                  double end, double reach_a, double reach_b) {
  const Vec3 velocity = a.velocity - b.velocity, acceleration = a.acceleration - b.acceleration;
  const double pull = n.dot(acceleration);
  const double linear = n.dot(velocity + t * acceleration) + std::max(0.0, pull * (end - t));
  // ANCHOR: bound
  const double turn_a = kind == MotionBound::naive ? a.spin_rate : n.cross(a.spin).norm();
  const double turn_b = kind == MotionBound::naive ? b.spin_rate : n.cross(b.spin).norm();
  const double angular = turn_a * reach_a + turn_b * reach_b;
  const double summed = velocity.norm() + end * acceleration.norm() + angular;
  return linear + angular + 16 * std::numeric_limits<double>::epsilon() * summed;
  // ANCHOR_END: bound
}

}  // namespace fc::ca

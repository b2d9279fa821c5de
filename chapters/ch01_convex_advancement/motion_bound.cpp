#include "ch01_convex_advancement/motion_bound.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "ch01_convex_advancement/gjk.hpp"

namespace fc::ca {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding =
    16 * std::numeric_limits<double>::epsilon();  // of a sum of speeds, relative to their sizes
constexpr int kMostTurns = 8;  // supports in turned directions for one step; usually one or two suffice

double reach_for(MotionBound bound, const Convex& shape, const Motion& motion) {
  if (bound < MotionBound::projected || motion.spin_rate == 0 || motion.free) return shape.reach;
  return reach_across(
      shape, motion.rotation.transpose() * motion.spin_axis);  // turns with the body: the same at any time
}

// kRounding times this is the error of a spin, in rad/s, for the velocities that follow from it. An angle
// error of the pose turns them by that angle; a spin that changes is known no better than the pose.
double spin_noise(const Motion& motion, double turned, double rate) {
  return motion.free ? turned * motion.spin_bound() : (1 + 0.5 * turned) * rate;
}

}  // namespace

MotionBound motion_bound_named(const std::string& name) {
  static constexpr std::array names = {"naive", "directional", "projected", "second_order"};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (name == names[i]) return static_cast<MotionBound>(i);
  throw std::invalid_argument("motion bound '" + name +
                              "'; it must be naive, directional, projected or second_order");
}

double crossing_time(double c, double k, double room) {
  const double discriminant = c * c + 4 * k * room;
  if (discriminant < 0) return kInfinity;
  const double root = std::sqrt(discriminant);
  if (c < 0) return k > 0 ? (root - c) / (2 * k) : kInfinity;
  return c + root > 0 ? 2 * room / (c + root) : kInfinity;
}

MovingPair::MovingPair(MotionBound bound, const Convex& a, const Motion& motion_a, const Convex& b,
                       const Motion& motion_b)
    : bound_(bound),
      a_{a, motion_a, reach_for(bound, a, motion_a)},
      b_{b, motion_b, reach_for(bound, b, motion_b)} {}

double MovingPair::closing_speed_bound(const Vec3& n, double t, double end) const {
  const Vec3 velocity = a_.motion.velocity - b_.motion.velocity,
             acceleration = relative_acceleration(a_.motion, b_.motion, t);
  const double pull = n.dot(acceleration);
  const double linear = n.dot(relative_velocity(a_.motion, b_.motion, t)) + std::max(0.0, pull * (end - t));
  // ANCHOR: bound
  const bool naive = bound_ == MotionBound::naive;
  const double turn_a = naive ? a_.motion.spin_bound() : a_.motion.turning_bound(n);
  const double turn_b = naive ? b_.motion.spin_bound() : b_.motion.turning_bound(n);
  const double angular = turn_a * a_.reach + turn_b * b_.reach;
  // ANCHOR_END: bound
  const double summed = velocity.norm() + end * acceleration.norm() + angular;
  return linear + angular + kRounding * summed;
}

double MovingPair::safe_time(const PairPose& pose, const Vec3& n, double gap, double target, double t,
                             double end) const {
  const double speed = closing_speed_bound(n, t, end);
  const double linear = speed > 0 ? (gap - target) / speed : kInfinity;
  if (linear >= end - t || bound_ != MotionBound::second_order) return linear;
  return std::max(linear, second_order_time(pose, n, target, t, end - t));
}

double MovingPair::second_order_time(const PairPose& pose, const Vec3& n, double target, double t,
                                     double remaining) const {
  // The normal, and its speed in the body's axes if the body is held fast.
  const Vec3 cross_a = n.cross(a_.motion.spin_at(t)), cross_b = n.cross(b_.motion.spin_at(t));
  const Vec3 n_a = pose.rotation_a.transpose() * n, n_b = pose.rotation_b.transpose() * n;
  const Vec3 turn_a = pose.rotation_a.transpose() * cross_a, turn_b = pose.rotation_b.transpose() * cross_b;
  const Vec3 velocity = relative_velocity(b_.motion, a_.motion, t);
  // |n.(d2r/dt2)| per metre of reach: n.(dw/dt x r) + (n x w).(w x r).
  const double rate_a = a_.motion.turning_bound(n), rate_b = b_.motion.turning_bound(n);
  const double bend_a = rate_a * a_.motion.spin_bound() + a_.motion.spin_change_bound(),
               bend_b = rate_b * b_.motion.spin_bound() + b_.motion.spin_change_bound();
  const double bend = 0.5 *
                      (bend_a * a_.reach + bend_b * b_.reach +
                       std::max(0.0, n.dot(relative_acceleration(a_.motion, b_.motion, t)))) *
                      (1 + kRounding);
  const double noise =
      kRounding * (velocity.norm() + spin_noise(a_.motion, pose.turned_a, rate_a) * a_.shape.reach +
                   spin_noise(b_.motion, pose.turned_b, rate_b) * b_.shape.reach);
  const double closing = noise - n.dot(velocity);
  const double middle = n.dot(pose.offset_world) - a_.shape.radius - b_.shape.radius -
                        rounding_term(a_.shape, b_.shape, pose) - target;

  double left_at_start = 0, h = 0;
  for (int turns = 0;; ++turns) {
    // ANCHOR: turned
    const Vec3 ahead_a = support(a_.shape, n_a + h * turn_a).point;
    const Vec3 ahead_b = support(b_.shape, -(n_b + h * turn_b)).point;
    const double room = middle + n_b.dot(ahead_b) - n_a.dot(ahead_a);
    const double speed = closing + turn_a.dot(ahead_a) - turn_b.dot(ahead_b);
    const double left = room - h * speed - h * h * bend;
    // ANCHOR_END: turned
    if (turns == 0) left_at_start = left;
    if (turns > 0 && left >= -kStepSlack * target) return h < remaining ? h : kInfinity;
    // When would these two points have used it up? Others may be ahead by then: no sooner than the true time.
    const double next = std::min(crossing_time(speed, bend, std::max(room, 0.0)), remaining);
    if (turns == kMostTurns || (turns > 0 && !(next < h)))  // concave: at least what the chord leaves
      return left_at_start > 0 ? h * left_at_start / (left_at_start - left) : 0;
    h = next;
  }
}

}  // namespace fc::ca

// The motion of a body over an interval, and of one body relative to another.
#pragma once

#include <cmath>
#include <memory>

#include "common/rigid_body.hpp"
#include "common/types.hpp"

namespace fc::ca {

// The rotation by the angle (rad) about a unit axis (Rodrigues' formula).
Mat3 rotation_about(const Vec3& axis, double angle);

// For a decay at the rate k (1/s): the integral of e^(-k s) over s in [0, t], in s; and the integral of that,
// in s^2.
inline double decayed_time(double k, double t) {
  return k == 0 ? t : -std::expm1(-k * t) / k;
}
double decayed_square(double k, double t);

// How a body with a varying spin turns, for all times t (s) before and after 0. Chapter 4 has such bodies; this chapter needs
// no more of them than this.
class VaryingSpin {
 public:
  virtual ~VaryingSpin() = default;
  virtual Mat3 rotation_at(double t) const = 0;  // body axes to world axes
  virtual Vec3 spin_at(double t) const = 0;      // rad/s, world axes
  // Bounds for all time: |w| and, for a unit n fixed in the world, |n x w|, in rad/s; |dw/dt| in rad/s^2; and how far w
  // strays from a fixed axis, in rad/s.
  virtual double spin_bound() const = 0;
  virtual double turning_bound(const Vec3& n) const = 0;
  virtual double spin_change_bound() const = 0;
  virtual double across_bound() const = 0;
};

// The motion of a free body: constant acceleration of its centre of mass, constant spin or a free rotation of
// its axes; drag may slow both.
//   x(t) = position + velocity t + acceleration t^2/2
//   R(t) = rotation(spin, t) R(0), or free->rotation_at(t)
//
// Drag in closed form, with k = drag and s(t) = (1 - e^(-kt))/k: from dv/dt = acceleration - k v,
//   v(t) = e^(-kt) velocity + s(t) acceleration
//   x(t) = position + s(t) velocity + (t - s(t))/k acceleration,
// and a torque of -k times the angular momentum (k = spin_drag) lets the body turn as it would without, but
// slower and slower: after t it is where it would have been after s(t), with e^(-kt) of the spin.
struct Motion {
  Vec3 position = Vec3::Zero();             // m, the centre of mass at t = 0, world
  Mat3 rotation = Mat3::Identity();         // shape axes to world axes at t = 0
  Vec3 velocity = Vec3::Zero();             // m/s at t = 0
  Vec3 acceleration = Vec3::Zero();         // m/s^2
  Vec3 spin = Vec3::Zero();                 // rad/s, world axes; at t = 0, if it changes
  Vec3 spin_axis = Vec3::UnitZ();           // spin / |spin|
  double spin_rate = 0;                     // |spin|
  std::shared_ptr<const VaryingSpin> free;  // none: the spin is constant. Shared: a motion is copied often
  double free_start = 0, free_rate = 1;     // s, and 1: where on its free motion the body is, and how fast
  double drag = 0, spin_drag = 0;           // 1/s

  Motion() = default;
  explicit Motion(const RigidBody& body, const Vec3& acceleration_world = Vec3::Zero());

  Mat3 rotation_at(double t) const;
  Vec3 position_at(double t) const;
  Vec3 velocity_at(double t) const;
  Vec3 acceleration_at(double t) const;
  Vec3 spin_at(double t) const;
  double free_time(double t) const { return free_start + free_rate * decayed_time(spin_drag, t); }
  Pose pose_at(double t) const { return {rotation_at(t), position_at(t)}; }

  // Bounds for all t >= 0: the largest |w| and, for a fixed unit n, |n x w| in rad/s, the largest |dw/dt| in
  // rad/s^2, and how far the spin's direction wanders: |n x w(t2)| <= |n x w(t1)| + wander, t1 < t2.
  double spin_bound() const { return free ? free_rate * free->spin_bound() : spin_rate; }
  double turning_bound(const Vec3& n) const;
  double spin_change_bound() const {
    const double free_change = free ? free_rate * free_rate * free->spin_change_bound() : 0;
    return free_change + spin_drag * spin_bound();
  }
  double wander() const { return free ? 2 * free_rate * free->across_bound() : 0; }

  // Constant acceleration and constant spin: only such motions can be replayed from a certificate.
  bool steady() const { return !free && drag == 0 && spin_drag == 0; }

  // How far the rotation at t can be off, in units of 8 eps rad.
  double turned(double t) const {
    return free ? 2 * (1 + free->spin_bound() * std::abs(free_time(t))) : spin_rate * t;
  }
};

// A's velocity (m/s) and acceleration (m/s^2) less B's at time t. Differences are taken first, so that what
// both have in common leaves no rounding. The acceleration keeps its direction and does not grow: what it is
// along n at t, or zero, bounds it along n from then on (with drag, if it is the same for both, or one of
// them has a constant velocity).
Vec3 relative_acceleration(const Motion& a, const Motion& b, double t);
Vec3 relative_velocity(const Motion& a, const Motion& b, double t);

// Both poses of a pair at one time, and B seen from A. Differences of positions and velocities are taken
// before anything is rotated, so that a pair far from the world's origin keeps its digits.
struct PairPose {
  Mat3 rotation_a;  // A's axes to world axes
  Mat3 rotation_b;
  Vec3 offset_world;          // B's centre of mass less A's, world
  Pose b_in_a;                // x_A = b_in_a * x_B
  double travelled;           // m, the size of the terms that offset_world sums up
  double turned_a, turned_b;  // rad, about the angles since t = 0: a pose is known to 8 eps times these

  PairPose(const Motion& a, const Motion& b, double t);
  // Two bodies at rest at these poses.
  PairPose(const Pose& a, const Pose& b);
};

}  // namespace fc::ca

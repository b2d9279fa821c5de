// The motion of a body over an interval, and of one body relative to another.
#pragma once

#include <cmath>
#include <memory>

#include "ch01_convex_advancement/torque_free.hpp"
#include "common/rigid_body.hpp"
#include "common/types.hpp"

namespace fc::ca {

// The rotation by the angle (rad) about a unit axis (Rodrigues' formula).
inline Mat3 rotation_about(const Vec3& axis, double angle) {
  const double s = std::sin(angle);
  const double half = std::sin(0.5 * angle);
  const double c = 2 * half * half;  // 1 - cos(angle), without the cancellation
  const double x = axis.x(), y = axis.y(), z = axis.z();
  Mat3 r;
  r << 1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y,  //
      c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x,   //
      c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y);
  return r;
}

// A body that flies: its centre of mass with constant acceleration, its axes with constant spin or freely.
//   x(t) = position + velocity t + acceleration t^2/2,   R(t) = rotation(spin, t) R(0)  or
//   free->rotation_at(t)
struct Motion {
  Vec3 position = Vec3::Zero();            // m, the centre of mass at t = 0, world
  Mat3 rotation = Mat3::Identity();        // shape axes to world axes at t = 0
  Vec3 velocity = Vec3::Zero();            // m/s at t = 0
  Vec3 acceleration = Vec3::Zero();        // m/s^2
  Vec3 spin = Vec3::Zero();                // rad/s, world axes; at t = 0, if it changes
  Vec3 spin_axis = Vec3::UnitZ();          // spin / |spin|
  double spin_rate = 0;                    // |spin|
  std::shared_ptr<const TorqueFree> free;  // none: the spin is constant. Shared: a motion is copied often

  Motion() = default;
  explicit Motion(const RigidBody& body, const Vec3& acceleration_world = Vec3::Zero())
      : position(body.position),
        rotation(body.orientation.toRotationMatrix()),
        velocity(body.velocity),
        acceleration(acceleration_world),
        spin(body.spin),
        spin_rate(body.spin.norm()) {
    if (spin_rate > 0) spin_axis = spin / spin_rate;
  }
  // From here on no torque acts: the spin follows Euler's equations. Of a body that this does not change (a
  // ball, or one that spins about a principal axis) nothing is changed.
  void turn_freely(const PrincipalInertia& inertia) {
    const TorqueFree turning(inertia, rotation, spin);
    free = turning.constant_spin() ? nullptr : std::make_shared<TorqueFree>(turning);
  }

  Mat3 rotation_at(double t) const {
    if (free) return free->rotation_at(t);
    return spin_rate == 0 ? rotation : Mat3(rotation_about(spin_axis, spin_rate * t) * rotation);
  }
  Vec3 position_at(double t) const { return position + t * (velocity + 0.5 * t * acceleration); }
  Vec3 velocity_at(double t) const { return velocity + t * acceleration; }
  Vec3 spin_at(double t) const { return free ? free->spin_at(t) : spin; }
  Pose pose_at(double t) const { return {rotation_at(t), position_at(t)}; }

  // What holds at any time: the largest |w| and, for a fixed unit n, |n x w| in rad/s, the largest |dw/dt| in
  // rad/s^2.
  double spin_bound() const { return free ? free->spin_bound() : spin_rate; }
  double turning_bound(const Vec3& n) const { return free ? free->turning_bound(n) : n.cross(spin).norm(); }
  double spin_change_bound() const { return free ? free->spin_change_bound() : 0; }

  // How far the rotation at t can be off, in units of 8 eps rad.
  double turned(double t) const { return free ? 2 * (1 + free->spin_bound() * t) : spin_rate * t; }
};

// Both poses of a pair at one time, and B seen from A. Differences of positions and velocities are taken
// before anything is rotated, so that a pair far from the world's origin keeps its digits.
struct PairPose {
  Mat3 rotation_a;  // A's axes to world axes
  Mat3 rotation_b;
  Vec3 offset_world;          // B's centre of mass less A's, world
  Pose b_in_a;                // x_A = b_in_a * x_B
  double travelled;           // m, the size of what offset_world is the sum of, and
  double turned_a, turned_b;  // rad, about the angles since t = 0: a pose is known to 8 eps times these

  PairPose(const Motion& a, const Motion& b, double t)
      : rotation_a(a.rotation_at(t)),
        rotation_b(b.rotation_at(t)),
        turned_a(a.turned(t)),
        turned_b(b.turned(t)) {
    const Vec3 position = b.position - a.position, velocity = b.velocity - a.velocity;
    const Vec3 acceleration = b.acceleration - a.acceleration;
    offset_world = position + t * (velocity + (0.5 * t) * acceleration);
    travelled = position.norm() + t * (velocity.norm() + (0.5 * t) * acceleration.norm());
    b_in_a.rotation = rotation_a.transpose() * rotation_b;
    b_in_a.position = rotation_a.transpose() * offset_world;
  }
};

}  // namespace fc::ca

// The motion of a body over an interval, and of one body relative to another.
#pragma once

#include <cmath>

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

// A body that flies: its centre of mass with constant acceleration, its axes with constant spin.
//   x(t) = position + velocity t + acceleration t^2/2,   R(t) = rotation(spin, t) R(0)
struct Motion {
  Vec3 position = Vec3::Zero();      // m, the centre of mass at t = 0, world
  Mat3 rotation = Mat3::Identity();  // shape axes to world axes at t = 0
  Vec3 velocity = Vec3::Zero();      // m/s at t = 0
  Vec3 acceleration = Vec3::Zero();  // m/s^2
  Vec3 spin = Vec3::Zero();          // rad/s, world axes
  Vec3 spin_axis = Vec3::UnitZ();    // spin / |spin|
  double spin_rate = 0;              // |spin|

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

  Mat3 rotation_at(double t) const {
    return spin_rate == 0 ? rotation : Mat3(rotation_about(spin_axis, spin_rate * t) * rotation);
  }
  Vec3 position_at(double t) const { return position + t * (velocity + 0.5 * t * acceleration); }
  Vec3 velocity_at(double t) const { return velocity + t * acceleration; }
  Pose pose_at(double t) const { return {rotation_at(t), position_at(t)}; }
};

// Both poses of a pair at one time, and B seen from A. Differences of positions and velocities are taken
// before anything is rotated, so that a pair far from the world's origin keeps its digits.
struct PairPose {
  Mat3 rotation_a;  // A's axes to world axes
  Mat3 rotation_b;
  Vec3 offset_world;          // B's centre of mass less A's, world
  Pose b_in_a;                // x_A = b_in_a * x_B
  double travelled;           // m, the size of what offset_world is the sum of, and
  double turned_a, turned_b;  // rad, the angles since t = 0: a pose is known to a few eps times these

  PairPose(const Motion& a, const Motion& b, double t)
      : rotation_a(a.rotation_at(t)),
        rotation_b(b.rotation_at(t)),
        turned_a(a.spin_rate * t),
        turned_b(b.spin_rate * t) {
    const Vec3 position = b.position - a.position, velocity = b.velocity - a.velocity;
    const Vec3 acceleration = b.acceleration - a.acceleration;
    offset_world = position + t * (velocity + (0.5 * t) * acceleration);
    travelled = position.norm() + t * (velocity.norm() + (0.5 * t) * acceleration.norm());
    b_in_a.rotation = rotation_a.transpose() * rotation_b;
    b_in_a.position = rotation_a.transpose() * offset_world;
  }
};

}  // namespace fc::ca

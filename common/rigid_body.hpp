// The state of a rigid body, and the small formulas that need nothing else.
#pragma once

#include "common/mass_properties.hpp"
#include "common/types.hpp"

namespace fc {

// A body's centre of mass, orientation and velocities in the world, and its inverse inertia. A static body
// has zero inverse mass and inertia, and does not move; a kinematic one has the same, and moves as the scene
// says.
struct RigidBody {
  Vec3 position = Vec3::Zero();         // m, the centre of mass
  Quat orientation = Quat::Identity();  // unit; turns the shape's own axes into world axes
  Vec3 velocity = Vec3::Zero();         // m/s, of the centre of mass
  Vec3 spin = Vec3::Zero();             // rad/s, world axes

  double mass = 0;                           // kg; 0 for a static or kinematic body
  double inverse_mass = 0;                   // 1/kg
  Vec3 free_moves = Vec3::Ones();            // 1 or 0: whether it can move along each of the world's axes
  Vec3 free_turns = Vec3::Ones();            // and turn about each of its own
  Mat3 inertia_body = Mat3::Zero();          // kg m^2, about the centre of mass, shape axes
  Mat3 inverse_inertia_body = Mat3::Zero();  // 1/(kg m^2)

  // No impulse moves it: static or kinematic.
  bool is_static() const { return inverse_mass == 0; }
  // Whether a degree of freedom was taken from it: something holds it there, and takes up its momentum.
  bool is_guided() const { return free_moves != Vec3::Ones() || free_turns != Vec3::Ones(); }
  Pose pose() const { return {orientation.toRotationMatrix(), position}; }

  Mat3 inertia_world() const {
    const Mat3 r = orientation.toRotationMatrix();
    return r * inertia_body * r.transpose();
  }
  Mat3 inverse_inertia_world() const {
    const Mat3 r = orientation.toRotationMatrix();
    return r * inverse_inertia_body * r.transpose();
  }
  // The velocity in m/s of the body's point that is at x (m, world).
  Vec3 velocity_at(const Vec3& x) const { return velocity + spin.cross(x - position); }
  double kinetic_energy() const {  // J
    return 0.5 * mass * velocity.squaredNorm() + 0.5 * spin.dot(inertia_world() * spin);
  }
  Vec3 momentum() const { return mass * velocity; }  // kg m/s
  Vec3 angular_momentum() const {                    // kg m^2/s, about the world's origin
    return position.cross(momentum()) + inertia_world() * spin;
  }
  void set_mass(const MassProperties& properties) {
    mass = properties.mass;
    inverse_mass = 1 / mass;
    inertia_body = properties.inertia;
    inverse_inertia_body = properties.inertia.inverse();
  }
  // After set_mass: takes degrees of freedom away. The inverse inertia then acts on the free turns alone.
  void guide(const Vec3& moves, const Vec3& turns) {
    free_moves = moves;
    free_turns = turns;
    if (turns == Vec3::Ones()) return;
    const Mat3 free = turns.asDiagonal(), fixed = (Vec3::Ones() - turns).asDiagonal();
    inverse_inertia_body = free * (free * inertia_body * free + fixed).inverse() * free;
  }
};

}  // namespace fc

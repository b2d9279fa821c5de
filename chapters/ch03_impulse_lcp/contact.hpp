// A contact: one point at which two bodies touch, and the direction in which they push.
#pragma once

#include <span>

#include "common/rigid_body.hpp"

namespace fc::lcp {

// Two bodies touch at one common point. The impulse j >= 0 (N s) acts there along +normal on B and along
// -normal on A. Two points a gap apart would make the pair of impulses change the total angular momentum.
struct Contact {
  int body_a = 0, body_b = 0;  // indices into the bodies; not equal
  Vec3 point = Vec3::Zero();   // m, world
  Vec3 normal = Vec3::Zero();  // unit, world, from A to B
  double gap = 0;              // m, distance of the two surfaces; reported, never used by the impact law
  double restitution = 0;      // Newton's epsilon, in [0, 1]
  // False: the normal passes through that body's centre of mass, as for a ball. The impulse then has no lever
  // arm, and the spin no part in the contact's velocity: nothing angular is computed.
  bool turns_a = true, turns_b = true;
};

// The velocity of B's point as seen from A's, v_B - v_A at the contact point, m/s.
inline Vec3 relative_velocity(std::span<const RigidBody> bodies, const Contact& contact) {
  const RigidBody& a = bodies[static_cast<std::size_t>(contact.body_a)];
  const RigidBody& b = bodies[static_cast<std::size_t>(contact.body_b)];
  const Vec3 velocity_a = contact.turns_a ? a.velocity_at(contact.point) : a.velocity;
  const Vec3 velocity_b = contact.turns_b ? b.velocity_at(contact.point) : b.velocity;
  return velocity_b - velocity_a;
}

// The component of that velocity along the normal, m/s: negative while the bodies approach.
inline double contact_velocity(std::span<const RigidBody> bodies, const Contact& contact) {
  return contact.normal.dot(relative_velocity(bodies, contact));
}

}  // namespace fc::lcp

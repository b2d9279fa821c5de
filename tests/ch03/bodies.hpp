// Bodies and sums over bodies for the tests of impacts.
#pragma once

#include <span>
#include <vector>

#include "ch03_impulse_lcp/contact.hpp"

namespace fc::lcp {

inline RigidBody ball(const Vec3& position, const Vec3& velocity, double mass = 1, double radius = 0.5) {
  RigidBody body;
  body.position = position;
  body.velocity = velocity;
  body.set_mass({mass, Vec3::Zero(), 0.4 * mass * radius * radius * Mat3::Identity()});
  return body;
}

inline RigidBody box(const Vec3& position, const Vec3& velocity, double mass = 1,
                     const Vec3& size = Vec3::Ones()) {
  RigidBody body;
  body.position = position;
  body.velocity = velocity;
  const Vec3 q = size.cwiseAbs2();
  const Vec3 inertia = mass / 12 * Vec3(q.y() + q.z(), q.x() + q.z(), q.x() + q.y());
  body.set_mass({mass, Vec3::Zero(), inertia.asDiagonal()});
  return body;
}

inline RigidBody wall() {
  return {};
}

// Balls of diameter 1 in a row along x, touching; the last contact is with a wall if there is one more body.
inline std::vector<Contact> row_of_contacts(int contacts, double restitution) {
  std::vector<Contact> row;
  for (int i = 0; i < contacts; ++i)
    row.push_back({i, i + 1, Vec3(i + 0.5, 0, 0), Vec3::UnitX(), 0, restitution});
  return row;
}

struct Sums {
  double energy = 0, momentum_size = 0, angular_size = 0;
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
};

inline Sums sums(std::span<const RigidBody> bodies) {
  Sums s;
  for (const RigidBody& body : bodies) {
    if (body.is_static()) continue;
    s.energy += body.kinetic_energy();
    s.momentum += body.momentum();
    s.angular += body.angular_momentum();
    s.momentum_size += body.momentum().norm();
    s.angular_size +=
        body.position.norm() * body.momentum().norm() + (body.inertia_world() * body.spin).norm();
  }
  return s;
}

}  // namespace fc::lcp

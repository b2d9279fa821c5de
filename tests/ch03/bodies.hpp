// Bodies and sums over bodies for the tests of impacts.
#pragma once

#include <cmath>
#include <random>
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

struct Heap {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
};

// `count` bodies at random places, each pair of neighbours with up to `points` contact points around one
// spot; body masses over `decades`; every point `copies` times. With a floor, body 0 is static.
inline Heap random_heap(std::mt19937_64& random, int count, int points, double decades, int copies,
                        bool floor) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto any = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  Heap heap;
  for (int i = 0; i < count; ++i) {
    const double mass = std::pow(10.0, decades * (uniform(random) - 0.5));
    const Vec3 size = Vec3::Constant(0.5) + 0.5 * any().cwiseAbs();
    RigidBody body = box(3 * any(), any(), mass, size);
    body.orientation = Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
    body.spin = any();
    heap.bodies.push_back(floor && i == 0 ? wall() : body);
  }
  for (int i = 1; i < count; ++i) {
    const int other = static_cast<int>(uniform(random) * i);
    const Vec3 spot = heap.bodies[static_cast<std::size_t>(i)].position + 0.5 * any();
    const Vec3 normal_here = any().normalized();
    for (int k = 0; k < points; ++k) {
      const Vec3 offset = any();
      const Vec3 point =
          spot + 0.3 * (offset - offset.dot(normal_here) * normal_here);  // in the contact plane
      for (int c = 0; c < copies; ++c) heap.contacts.push_back({other, i, point, normal_here, 0, 0});
    }
  }
  return heap;
}

}  // namespace fc::lcp

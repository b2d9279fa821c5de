#include "ex04_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {
namespace {

// The velocity (m/s) along the normal that 1 N s gives to the body's point, 1/kg.
double response(const RigidBody& body, const lcp::Contact& contact) {
  const Vec3 arm = (contact.point - body.position).cross(contact.normal);
  return body.inverse_mass + arm.dot(body.inverse_inertia_world() * arm);
}

void push(RigidBody& body, const Vec3& point, const Vec3& impulse) {
  body.velocity += body.inverse_mass * impulse;
  body.spin += body.inverse_inertia_world() * (point - body.position).cross(impulse);
}

void push_both(std::span<RigidBody> bodies, const lcp::Contact& contact, double impulse) {
  push(bodies[static_cast<std::size_t>(contact.body_a)], contact.point, -impulse * contact.normal);
  push(bodies[static_cast<std::size_t>(contact.body_b)], contact.point, impulse * contact.normal);
}

}  // namespace

double effective_mass(std::span<const RigidBody> bodies, const lcp::Contact& contact) {
  return 1 / (response(bodies[static_cast<std::size_t>(contact.body_a)], contact) +
              response(bodies[static_cast<std::size_t>(contact.body_b)], contact));
}

void apply(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
           std::span<const double> impulses) {
  for (std::size_t i = 0; i < contacts.size(); ++i) push_both(bodies, contacts[i], impulses[i]);
}

double sweep(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
             std::span<const double> approach_limits, std::span<double> impulses) {
  double largest = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double mass = effective_mass(bodies, contacts[i]);
    const double w = lcp::contact_velocity(bodies, contacts[i]) + approach_limits[i];
    // It is the sum that must not pull: what was too much in an earlier sweep may be taken back.
    const double after = std::max(0.0, impulses[i] - mass * w);
    const double change = after - impulses[i];
    impulses[i] = after;
    push_both(bodies, contacts[i], change);
    largest = std::max(largest, std::abs(change) / mass);
  }
  return largest;
}

int solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
          std::span<const double> approach_limits, std::span<double> impulses, double enough, int most) {
  apply(bodies, contacts, impulses);
  int sweeps = 0;
  while (sweeps < most) {
    ++sweeps;
    if (sweep(bodies, contacts, approach_limits, impulses) <= enough) break;
  }
  return sweeps;
}

}  // namespace fc::exercises

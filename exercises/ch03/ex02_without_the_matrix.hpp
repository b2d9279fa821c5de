// Exercise 3.2: the Delassus matrix as an operator.
#pragma once

#include <algorithm>
#include <span>
#include <stdexcept>

#include "ch03_impulse_lcp/contact.hpp"

namespace fc::exercises {

// What a body's motion changes by.
struct Kick {
  Vec3 velocity = Vec3::Zero();  // m/s, of the centre of mass
  Vec3 spin = Vec3::Zero();      // rad/s, world
};

// The bodies as a product with A sees them: places, and one thing that costs and is counted.
class Masses {
 public:
  explicit Masses(std::span<const RigidBody> bodies) : bodies_(bodies) {}

  int size() const { return static_cast<int>(bodies_.size()); }
  bool is_static(int body) const { return at(body).is_static(); }
  Vec3 position(int body) const { return at(body).position; }  // m, world, the centre of mass

  // M^-1 for one body: what `impulse` (N s) through its centre of mass, and `moment` (N m s) about it, both
  // in world axes, change its motion by. Throws std::invalid_argument for a static body: nothing changes
  // that.
  Kick kick(int body, const Vec3& impulse, const Vec3& moment) {
    const RigidBody& b = at(body);
    if (b.is_static()) throw std::invalid_argument("a static body was kicked");
    ++kicks_;
    return {b.inverse_mass * impulse, b.inverse_inertia_world() * moment};
  }
  int kicks() const { return kicks_; }  // so far

 private:
  const RigidBody& at(int body) const { return bodies_[static_cast<std::size_t>(body)]; }

  std::span<const RigidBody> bodies_;
  int kicks_ = 0;
};

// A z: how much the impulses z (n, N s, of any sign) change the velocities at the n contacts (m/s), for
// A = J M^-1 J' as lcp::assemble() builds it, to within 1e-12 of the largest product that is summed.
// Each moving body is kicked at most once, however many contacts it has; time and memory are proportional to
// the number of bodies plus that of contacts.
VecX delassus_times(Masses& masses, std::span<const lcp::Contact> contacts, const VecX& z);

// The largest eigenvalue of A, 1/kg, from below: at most the true one (up to 1e-12 of it), and at least 0.98
// of it for 1 to 200 contacts. 0 if A is 0, and if there are no contacts.
//   products: the largest number of products with A that may be spent; the 0.98 wants 400.
double largest_eigenvalue(Masses& masses, std::span<const lcp::Contact> contacts, int products);

// ---- Given: a solver that needs nothing else. ----

// The impulses after so many steps of projected gradients, z <- max(0, z - (A z + b) / L), from 0 on:
// downhill in the energy 1/2 z'Az + b'z, as far as A's largest eigenvalue L allows without climbing.
//   b: n, m/s; largest: 1/kg, > 0
inline VecX projected_gradients(Masses& masses, std::span<const lcp::Contact> contacts, const VecX& b,
                                double largest, int steps) {
  VecX z = VecX::Zero(b.size());
  for (int k = 0; k < steps; ++k) {
    const VecX w = delassus_times(masses, contacts, z) + b;
    z = (z - w / largest).cwiseMax(0.0);
  }
  return z;
}

}  // namespace fc::exercises

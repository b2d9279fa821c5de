// What happens to the velocities of an island at one instant.
#pragma once

#include <functional>

#include "ch05_resting_contact/contact_law.hpp"
#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

struct InstantOptions {
  double rest_speed = 0;  // m/s: bodies bounce only if a contact approaches faster
  double time = 0;        // s in the frame
  double guess = 0;       // s: the impulse of a contact's force over this time is the first guess
  std::function<bool(int body)> bounces;  // whether the body may still bounce in this frame
  IslandOptions solver;
};

struct InstantResult {
  bool solved = true;
  bool impact = false;  // a contact approached faster than rest_speed
  std::vector<world::ImpactRecord> records;
  std::vector<std::uint64_t> keys;  // of their points
  int contacts = 0, rows = 0, solves = 0, steps = 0;
  lcp::Status status = lcp::Status::limit;  // if not solved
  double residual = 0, kinematic_work = 0, energy_gain = 0;
};

// The record of an impulse (N s, world, on B): the velocities of B's point relative to A's, before and after it (m/s).
world::ImpactRecord record_of(double time, const lcp::Contact& contact, const Vec3& before, const Vec3& after,
                              const Vec3& impulse, world::ContactKind kind);

// Afterwards no contact of the island approaches. First come the contacts that last: where a plan has pushed, closing
// is the other half of its force, and no impact. They are stopped without bounce. Then two stages (Poisson's
// hypothesis, with a cap):
//   1. compression   z >= 0 stops every approach: J v1 >= 0, z'J v1 = 0;
//   2. expansion     each contact gives back what its restitution says, k e_i z_i, with the largest k <= 1 for which this takes
//                    no more energy than the compression gave: k^2 r'A r <= z'A z, r_i = e_i z_i.
// With one restitution for all, k is 1 and this is chapter 3's law; with several it cannot gain energy, as that law
// could. It is an impact, with restitution, if a contact approaches faster than rest_speed; else all e_i are 0. What
// then still approaches is stopped by a last compression. A contact that approaches fast from farther than the rest gap
// is left alone: it will be an event later.
InstantResult resolve_instant(const world::World& world, Island& island, double margin, ContactLaw& law,
                              const InstantOptions& options);

}  // namespace fc::resting

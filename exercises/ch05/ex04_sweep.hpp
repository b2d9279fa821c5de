// Exercise 5.4: a sweep over the rows that never sees a matrix: projected Gauss-Seidel by bodies.
#pragma once

#include <span>

#include "ch03_impulse_lcp/contact.hpp"

namespace fc::exercises {

// In all of this, each contact joins two bodies of which at least one can move, and both turn (`turns_a`, `turns_b`).
// The rows ask for impulses z >= 0 (N s), one for each contact, with
//   w = J v + approach_limits >= 0,   z'w = 0,   v = v_0 + M^-1 J' z,
// where J v are the contacts' velocities (m/s, negative: closing in) and `approach_limits` (m/s) says how fast each may
// close in; negative: it must part.

// The effective mass of two bodies at a contact, kg: 1 N s there changes the contact's velocity by 1 / effective_mass
// m/s.
double effective_mass(std::span<const RigidBody> bodies, const lcp::Contact& contact);

// Gives impulses to the bodies: v += M^-1 J' z. They act at the contacts' points, on A and B, and change the
// velocities and spins of the bodies that can move.
void apply(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
           std::span<const double> impulses);

// One sweep: visits the contacts in the order given, and changes each z_i to the solution of row i alone, with the
// bodies' velocities as the rows before have left them. `impulses` are the z so far, which the bodies' velocities
// contain already (from apply(), or from earlier sweeps); they are updated with the velocities, and stay >= 0. Returns
// the largest |change of a contact's velocity by its own row|, m/s: 0 if everything is solved. The cost of a contact
// does not depend on how many contacts there are.
double sweep(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
             std::span<const double> approach_limits, std::span<double> impulses);

// Sweeps until a sweep changes nothing by more than `enough` (m/s, > 0), at most `most` times; returns the number of
// sweeps, the last one included. `impulses` comes in as a guess, which the velocities do not contain yet, and becomes
// the answer.
int solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
          std::span<const double> approach_limits, std::span<double> impulses, double enough, int most);

}  // namespace fc::exercises

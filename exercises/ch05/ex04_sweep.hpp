// Exercise 5.4: a sweep over the rows that never sees a matrix: projected Gauss-Seidel by bodies.
#pragma once

#include <span>

#include "ch03_impulse_lcp/contact.hpp"

namespace fc::exercises {

// In all of this, contacts join bodies at least one of which can move, and both turn (`turns_a`, `turns_b`).
// Rows ask for impulses z >= 0 (N s), one for each contact, with
//   w = J v + approach_limits >= 0,   z'w = 0,   v = v_0 + M^-1 J' z,
// where J v are the contacts' velocities (m/s, negative: closing in) and `approach_limits` (m/s) is how fast each may
// close in; negative: it must part.

// The mass in kg with which two bodies answer at a contact: 1 N s there changes the contact's velocity by
// 1 / effective_mass m/s.
double effective_mass(std::span<const RigidBody> bodies, const lcp::Contact& contact);

// Gives impulses to the bodies: v += M^-1 J' z. They act at the contacts' points, on A and B, and change the
// velocities and spins of the bodies that can move.
void apply(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
           std::span<const double> impulses);

// One sweep: contact by contact, in the order given, changes z_i to what solves row i alone, with the bodies'
// velocities as the rows before have left them. `impulses` are the z so far, which the bodies' velocities
// have got already (by apply(), or by sweeps before); they are changed with the velocities, and stay >= 0.
// Returns the largest |change of a contact's velocity by its own row|, m/s: 0 if all is solved. The cost of a
// contact does not depend on how many there are.
double sweep(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
             std::span<const double> approach_limits, std::span<double> impulses);

// Sweeps until one changes no more than `enough` (m/s, > 0), at most `most` times; returns how many there
// were, that last one included. `impulses` are a guess that the velocities have not heard of yet, and become
// the answer.
int solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
          std::span<const double> approach_limits, std::span<double> impulses, double enough, int most);

}  // namespace fc::exercises

// The Delassus matrix: how strongly an impulse at one contact changes the velocity at another.
#pragma once

#include <span>

#include "ch03_impulse_lcp/contact.hpp"

namespace fc::lcp {

// The rows of an impact problem, w = A z + b.
struct ImpactProblem {
  MatX A;         // n by n, 1/kg: A_ij = change of the velocity at contact i for a unit impulse at contact j
  VecX b;         // n, m/s: (1 + epsilon_i) v_i before the impact
  VecX v_before;  // n, m/s
};

// Throws std::invalid_argument, naming the contact, for a body index out of range, two equal bodies, a normal
// that is not unit, a restitution outside [0, 1], or a point or velocity that is not finite.
void check_contacts(std::span<const RigidBody> bodies, std::span<const Contact> contacts);

// Builds A = J M^-1 J' and b = (1 + epsilon) v for contacts between bodies (paper section 4, eq. 1): with
// impulses z the velocities after the impact are v+ = A z + v, so that w = A z + b = v+ + epsilon v.
//   contacts: n; their body indices must be valid and different, their normals unit.
// Guarantees: A is exactly symmetric, each pair being computed once; static bodies (zero inverse mass)
// contribute nothing; an entry is computed only if its two contacts share a body that can move, the others
// are exactly 0. A is positive semidefinite up to round-off, and singular wherever contacts are redundant.
// Throws std::invalid_argument for a body index out of range, two equal bodies, a normal that is not unit, a
// restitution outside [0, 1], or a number that is not finite.
ImpactProblem assemble(std::span<const RigidBody> bodies, std::span<const Contact> contacts);

}  // namespace fc::lcp

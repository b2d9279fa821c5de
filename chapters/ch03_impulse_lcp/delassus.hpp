// The Delassus matrix: how strongly an impulse at one contact changes the velocity at another.
#pragma once

#include <span>
#include <vector>

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

// The same matrix as an operator: A z = J M^-1 J' z, from right to left. J' z sums up the impulses on each
// body, M^-1 turns them into velocities, and J takes these to the contacts. That costs O(n + bodies), where
// the matrix of a pile has up to O(n^2) entries, and suffices for methods that only multiply by A.
class DelassusOperator {
 public:
  // Throws as assemble() does. Keeps nothing of the arguments.
  DelassusOperator(std::span<const RigidBody> bodies, std::span<const Contact> contacts);

  Eigen::Index size() const { return static_cast<Eigen::Index>(rows_.size()); }
  // v := A z. z, v: n, N s and m/s; allocates nothing if v has n entries.
  void apply(const VecX& z, VecX& v);
  // A_ii, 1/kg.
  VecX diagonal() const;

 private:
  // One body's part of a contact's row of J, and of its column of M^-1 J'. Without the sign of A.
  struct Part {
    int body;          // -1: static
    Vec3 moves;        // the normal, along what the body is free to move
    Vec3 arm;          // m, r x n
    Vec3 spin_change;  // 1/(kg m), I^-1 (r x n)
    double inverse_mass;
  };
  struct Row {
    Vec3 normal;
    Part a, b;
  };
  struct Change {
    Vec3 velocity, spin;
  };
  std::vector<Row> rows_;
  std::vector<Change> changes_;  // of the bodies' velocities, for one apply()
};

}  // namespace fc::lcp

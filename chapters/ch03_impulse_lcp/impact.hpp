// The impact law: velocities just after bodies have hit each other, at any number of contacts at once.
#pragma once

#include <span>
#include <vector>

#include "ch03_impulse_lcp/contact.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp {

struct ImpactOptions {
  // An impact may leave contacts approaching that were separating before it; then it is solved again in the
  // same instant. The largest number of solves, >= 2; the last has restitution 0 for all, after which nothing
  // approaches.
  int max_solves = 8;
  // Rows -> impulses; empty means Dantzig's method. Its answer is checked before any velocity changes.
  Solver solver;
};

// One impulse that was applied.
struct Impulse {
  int contact = 0;      // index into the contacts
  int solve = 0;        // 0 for the first solve of the instant
  double v_before = 0;  // m/s, contact_velocity before and after this solve
  double v_after = 0;
  double impulse = 0;  // N s, > 0
};

struct ImpactResult {
  Status status = Status::solved;  // of the first solve that failed; unless solved, no body was changed
  std::vector<Impulse> impulses;   // solve by solve, in the order of the contacts; only those > 0
  int solves = 0;                  // 0: nothing approached
  int rows = 0;                    // of all solves together
  int pivots = 0;                  // of all solves together
  double worst_residual = 0;       // of the solves
  int failed_pivots = 0;           // of the last solve, the one that failed
  double failed_residual = 0;
  double energy_change = 0;     // J, measured on the bodies
  double energy_identity = 0;   // J, the exact value: 1/2 sum (1 - epsilon_i) j_i v_i- plus kinematic_work
  double kinematic_work = 0;    // J, done by moving bodies of infinite mass
  double fastest_approach = 0;  // m/s, >= 0: left after the last solve, below approach_rounding
  // Mixed restitutions had no solution: the smallest of the set was used for all.
  bool restitution_lowered = false;
};

// Changes the velocities of a contact's two bodies by an impulse (N s) along its normal, at its point. The
// spin of a body stays where Contact::turns_a or turns_b is false.
void apply_impulse(std::span<RigidBody> bodies, const Contact& contact, double impulse);
// The same by an impulse on B in any direction (N s, world), and its reaction on A.
void apply_impulse(std::span<RigidBody> bodies, const Contact& contact, const Vec3& impulse);

// The work (J) of a contact's kinematic body on the other one, by an impulse on B (N s, world): the impulse times the
// kinematic body's velocity along it. 0 without a kinematic body.
double kinematic_work(std::span<const RigidBody> bodies, const Contact& contact, const Vec3& impulse);
inline double kinematic_work(std::span<const RigidBody> bodies, const Contact& contact, double impulse) {
  return kinematic_work(bodies, contact, Vec3(impulse * contact.normal));
}

// The speed below which a contact of this set does not count as approaching, in m/s: the round-off of
// n.(v_B - v_A), 1e-12 of the fastest of the touching points (each |velocity| + |spin| |arm|). resolve_impact
// takes the fastest of the whole instant, since speeds that have cancelled leave their round-off.
double approach_rounding(std::span<const RigidBody> bodies, std::span<const Contact> contacts);

// Changes the velocities of the bodies so that no contact approaches, by Newton's law for many contacts at
// once (paper section 4, eq. 1): v+ + epsilon v- >= 0, j >= 0, j'(v+ + epsilon v-) = 0, each impulse at the
// one point of its contact.
//   bodies:   every body that a contact names; positions do not change.
//   contacts: n, see contact.hpp.
// Guarantees, if status is solved: every solve had a residual <= 1e-10 and passed acceptable(), and the
// velocities that the bodies actually have fulfil v+ >= -epsilon v- to within 1e-10 of the speeds involved;
// linear and angular momentum change only at static bodies; with one epsilon for all the kinetic energy does
// not grow: its change in each solve is -1/2 (1 - epsilon)/(1 + epsilon) j'Aj. Mixed restitutions may gain
// energy, see energy_identity. A body without an impulse keeps its state bit by bit, and so does every body
// if nothing approaches or the status is not solved. Throws std::invalid_argument for contacts that
// assemble() refuses, and for max_solves < 2.
ImpactResult resolve_impact(std::span<RigidBody> bodies, std::span<const Contact> contacts,
                            const ImpactOptions& options = {});

}  // namespace fc::lcp

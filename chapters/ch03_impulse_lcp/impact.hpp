// The impact law: velocities just after bodies have hit each other, at any number of contacts at once.
#pragma once

#include <span>
#include <vector>

#include "ch03_impulse_lcp/contact.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp {

struct ImpactOptions {
  // An impact may leave contacts approaching that were separating before it; then it is solved again in the
  // same instant, at most so many times, >= 2, the last with restitution 0 for all, after which nothing
  // approaches.
  int max_solves = 8;
  // Rows -> impulses; empty means Dantzig's method. Whatever stands here, its answer is checked before any
  // velocity changes.
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
  int failed_pivots = 0;           // of the last solve, the one that failed: how far it came
  double failed_residual = 0;
  double energy_change = 0;     // J, measured on the bodies
  double energy_identity = 0;   // J, 1/2 sum (1 - epsilon_i) j_i v_i- and kinematic_work: what it must be
  double kinematic_work = 0;    // J, done by bodies of infinite mass that move
  double fastest_approach = 0;  // m/s, >= 0: what is left after the last solve, below the stated rounding
  // Mixed restitutions had no solution: the smallest of the set was used for all.
  bool restitution_lowered = false;
};

// Changes the velocities of a contact's two bodies by an impulse (N s) along its normal, at its point; of a
// body that it does not turn (Contact::turns_a, turns_b) not the spin.
void apply_impulse(std::span<RigidBody> bodies, const Contact& contact, double impulse);
// The same by an impulse on B in any direction (N s, world), and its reaction on A.
void apply_impulse(std::span<RigidBody> bodies, const Contact& contact, const Vec3& impulse);

// What an impulse on B (N s, world) at a body that no impulse moves, but that moves by itself, does to the energy of the
// other: impulse times that body's velocity along it, J.
double kinematic_work(std::span<const RigidBody> bodies, const Contact& contact, const Vec3& impulse);
inline double kinematic_work(std::span<const RigidBody> bodies, const Contact& contact, double impulse) {
  return kinematic_work(bodies, contact, Vec3(impulse * contact.normal));
}

// The velocity below which a contact of this set does not count as approaching, in m/s: round-off of the
// velocities that cancel in v = n.(v_B - v_A), 1e-12 of the fastest of the touching points (each |velocity| +
// |spin| |arm|). resolve_impact takes the fastest of the whole instant, so that what it leaves is not
// round-off of round-off.
double approach_rounding(std::span<const RigidBody> bodies, std::span<const Contact> contacts);

// Changes the velocities of the bodies so that no contact approaches, by Newton's law for many contacts at
// once (paper section 4, eq. 1): v+ + epsilon v- >= 0, j >= 0, j'(v+ + epsilon v-) = 0, each impulse at the
// one point of its contact.
//   bodies:   every body that a contact names; positions do not change.
//   contacts: n, see contact.hpp.
// Guarantees, if status is solved: every solve had a residual <= 1e-10 and passed acceptable(), and the
// velocities that the bodies really got fulfil v+ >= -epsilon v- to within 1e-10 of the speeds involved;
// linear and angular momentum change only at static bodies; with one epsilon for all the kinetic energy does
// not grow: its change in each solve is -1/2 (1 - epsilon)/(1 + epsilon) j'Aj. Mixed restitutions may gain
// energy, see energy_identity. A body without an impulse, and every body if nothing approaches or the status
// is not solved, keeps its bits. Throws std::invalid_argument for contacts that assemble() refuses, and for
// max_solves < 2.
ImpactResult resolve_impact(std::span<RigidBody> bodies, std::span<const Contact> contacts,
                            const ImpactOptions& options = {});

}  // namespace fc::lcp

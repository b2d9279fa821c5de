// The impact law with friction: velocities just after bodies have hit each other, at any number of contacts.
//
// Newton's law with Coulomb's friction can gain energy: a rod that hits the floor with its lower end at 45° leaves with
// 64/41 of it. Here an impact has two stages, after Poisson, and a cap.
//   compression  r¹ solves the cone problem without restitution (cone_problem.hpp): ΔE <= -½ r¹'Ar¹.
//   expansion    gives back a share of the normal impulses, r²_N = κ ε r¹_N (ε of each contact), against friction that
//                may be up to µ r²_N and removes as much energy as it can (Tresca's problem, convex):
//                ΔE <= ½ r²_N'A r²_N, since u_N = 0 where r¹_N > 0, and r²_T = 0 was allowed.
//   cap          κ <= 1 is the largest for which ½ r²_N'A r²_N <= ½ r¹'Ar¹: no more energy is given back than was taken.
// So no impact gains energy, for any µ and any mix of restitutions. Without friction, and with one ε, κ is 1, and the
// law is chapter 3's: r = (1 + ε) r¹. With one contact whose normal and tangents do not couple it is Newton's,
// Poisson's and Stronge's law.
#pragma once

#include <vector>

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// The impact. It holds references: all must outlive the call. A, rows and mu are as in ConeProblem.
struct FrictionImpact {
  const MatX& A;            // 3n by 3n, 1/kg
  const VecX& u;            // 3n, m/s, relative velocities before
  const VecX& mu;           // n
  const VecX& restitution;  // n, in [0, 1]
};

// One pass of the two stages.
struct ImpactPass {
  VecX compression, expansion;  // 3n, N s: r¹ and r²
  double cap = 1;               // κ, in [0, 1]
  double compressed = 0;        // J, energy_change of r¹, <= -½ r¹'Ar¹
  double expanded = 0;          // J, what r² adds to it, <= ½ r¹'Ar¹
};

struct FrictionImpactResult {
  Status status = Status::solved;  // of the first solve that failed; unless it is solved, r is 0
  VecX r;                          // 3n, N s, of all passes together
  VecX u;                          // 3n, m/s, velocities after: A r + u
  std::vector<ImpactPass> passes;  // none: nothing approached
  double energy_change = 0;        // J, of r
  double fastest_approach = 0;     // m/s, >= 0: the approach that is left
};

struct FrictionImpactOptions {
  // A pass may leave contacts approaching that were separating; then another pass follows in the same instant: at most
  // this many, >= 2, the last without restitution, after which nothing approaches.
  int max_passes = 8;
  Method method = Method::combined;
  SolveOptions solve = {};
};

// Guarantees, if status is solved: ΔE <= 0, and ΔE <= -½ r'Ar for the compression of each pass, to within the
// solver's tolerance; no contact approaches faster than 1e-9 of the velocities that cancel in it. Every impulse of a
// stage is in its cone, and so is their sum. Throws std::invalid_argument as check_arguments() does, for restitutions
// outside [0, 1], and for max_passes < 2.
FrictionImpactResult two_stage_impact(const FrictionImpact& impact,
                                      const FrictionImpactOptions& options = {});

// The cone problem whose answer solves Tresca's: r_N,i = radius_i (N s, >= 0) whatever the velocities, and r_T, up to
// radius_i at each contact, is the friction that removes most energy. Each normal gets a row of its own, which is not
// coupled to the others, and µ = 1: Coulomb's law with a known normal impulse.
ConeResult solve_discs(const MatX& A, const VecX& u, const VecX& radius, Method method,
                       const SolveOptions& options);

}  // namespace fc::friction

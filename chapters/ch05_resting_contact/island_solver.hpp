// The rows of resting contacts, solved island by island: exactly where that is cheap, else to a residual that
// is checked and told.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ch03_impulse_lcp/contact.hpp"
#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch05_resting_contact/crowd.hpp"
#include "common/scene.hpp"

namespace fc::resting {

struct IslandOptions {
  int most_dense_rows =
      400;                 // up to so many, Dantzig's method; beyond, Gauss-Seidel with conjugate directions
  double residual = 1e-8;  // at which Gauss-Seidel is done, scale-free as in chapter 3
  double accepted = 1e-5;  // with which it may end after the last sweep
  int most_sweeps = 1000;
  std::optional<SolverSpec> chosen =
      {};  // the scene's solver, if it says more than the default: it alone, always
};

struct IslandResult {
  bool solved = false;
  double residual = 0;  // reached
  int sweeps = 0;       // 0: Dantzig's method; of a chosen solver its pivots, sweeps or steps
  lcp::Status status = lcp::Status::limit;  // of the chosen solver
};

// Finds impulses z >= 0 (N s), n, for contacts between bodies with
//   w = J v+ + allowed >= 0,   z'w = 0,   v+ = v + M^-1 J' z,
// and changes the bodies' velocities to v+: contact i may close in with at most allowed_i (m/s; negative: it
// must part). z comes in as a guess. Where one method fails the other is tried. Unless solved (to 1e-10, or
// to `accepted`; by the chosen solver to its tolerance), velocities stay as they are.
class IslandSolver {
 public:
  IslandResult solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                     std::span<const double> allowed, std::span<double> z, const IslandOptions& options);

 private:
  IslandResult solve_dense(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                           std::span<const double> allowed, std::span<double> z,
                           const std::optional<SolverSpec>& chosen = {});
  IslandResult solve_sparse(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                            std::span<const double> allowed, std::span<double> z,
                            const IslandOptions& options);

  Rows<double> rows_;
  lcp::DantzigSolver dantzig_;
};

}  // namespace fc::resting

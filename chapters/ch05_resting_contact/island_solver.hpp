// The rows of an island, solved exactly.
#pragma once

#include <optional>
#include <span>

#include "ch03_impulse_lcp/contact.hpp"
#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch05_resting_contact/gauss_seidel.hpp"
#include "common/scene.hpp"

namespace fc::resting {

struct IslandOptions {
  std::optional<SolverSpec> chosen =
      {};            // the scene's solver, if it differs from the default: then it is the only one used
  double still = 0;  // m/s: slower contacts stand still
};

struct IslandResult {
  bool solved = false;
  double residual = 0;  // reached
  int steps = 0;        // of a chosen solver: its pivots, sweeps or steps
  lcp::Status status = lcp::Status::limit;
};

// Finds impulses z >= 0 (N s), n, for contacts between bodies with
//   w = J v+ + approach_limits >= 0,   z'w = 0,   v+ = v + M^-1 J' z,
// and changes the bodies' velocities to v+: contact i may close in with at most approach_limits[i] (m/s; negative: it
// must part). z comes in as a guess. Dantzig's method solves it; where that fails, sweeps do, to 1e-3; a chosen solver,
// to its tolerance. Unless solved, velocities stay as they are. With a kinematic body, a solution that makes bodies a
// hundred times as fast as anything was is rejected: the kinematic body is squeezing bodies out, with unlimited force.
class IslandSolver {
 public:
  IslandResult solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                     std::span<const double> approach_limits, std::span<double> z,
                     const IslandOptions& options);

 private:
  void sweep(std::span<const RigidBody> bodies, std::span<const lcp::Contact> contacts,
             std::span<const double> approach_limits, std::span<const double> z, lcp::LcpResult& result);

  GaussSeidel gauss_seidel_;
  lcp::DantzigSolver dantzig_;
};

}  // namespace fc::resting

#include "ch05_resting_contact/island_solver.hpp"

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace fc::resting {

IslandResult IslandSolver::solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                 std::span<const double> allowed, std::span<double> z,
                                 const IslandOptions& options) {
  constexpr int kSweeps = 5000;
  constexpr double kResidual = 1e-5;
  lcp::ImpactProblem problem = lcp::assemble(bodies, contacts);
  const auto n = static_cast<Eigen::Index>(contacts.size());
  problem.b += Eigen::Map<const VecX>(allowed.data(), n);
  const lcp::Lcp rows{problem.A, problem.b};
  const VecX guess = Eigen::Map<const VecX>(z.data(), n);
  const VecX* start = guess.maxCoeff() > 0 ? &guess : nullptr;
  lcp::LcpResult result;
  if (options.chosen) {
    const SolverSpec& chosen = *options.chosen;
    result = lcp::solve(rows, lcp::method_named(chosen.method),
                        {.limit = chosen.limit, .tolerance = chosen.tolerance, .start = start});
  } else {
    dantzig_.solve(rows, {.start = start}, result);
    if (result.status != lcp::Status::solved)
      result = lcp::solve(rows, lcp::Method::pgs, {.limit = kSweeps, .tolerance = kResidual, .start = start});
  }
  const int steps = options.chosen ? result.pivots : 0;
  if (result.status != lcp::Status::solved) return {false, result.residual, steps, result.status};
  for (Eigen::Index i = 0; i < n; ++i) {
    z[static_cast<std::size_t>(i)] = result.z[i];
    if (result.z[i] > 0) lcp::apply_impulse(bodies, contacts[static_cast<std::size_t>(i)], result.z[i]);
  }
  return {true, result.residual, steps, result.status};
}

}  // namespace fc::resting

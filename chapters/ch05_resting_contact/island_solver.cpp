#include "ch05_resting_contact/island_solver.hpp"

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace fc::resting {
IslandResult IslandSolver::solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                 std::span<const double> allowed, std::span<double> z,
                                 const IslandOptions& options) {
  if (options.chosen) return solve_dense(bodies, contacts, allowed, z, options.chosen);
  if (static_cast<int>(contacts.size()) <= options.most_dense_rows) {
    const IslandResult dense = solve_dense(bodies, contacts, allowed, z);
    if (dense.solved) return dense;
  }
  return solve_sparse(bodies, contacts, allowed, z, options);
}

IslandResult IslandSolver::solve_dense(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                       std::span<const double> allowed, std::span<double> z,
                                       const std::optional<SolverSpec>& chosen) {
  lcp::ImpactProblem problem = lcp::assemble(bodies, contacts);
  const auto n = static_cast<Eigen::Index>(contacts.size());
  for (Eigen::Index i = 0; i < n; ++i) problem.b[i] += allowed[static_cast<std::size_t>(i)];
  const lcp::Lcp rows{problem.A, problem.b};
  const VecX guess = Eigen::Map<const VecX>(z.data(), n);
  const VecX* start = guess.maxCoeff() > 0 ? &guess : nullptr;
  lcp::LcpResult result;
  if (chosen)
    result = lcp::solve(rows, lcp::method_named(chosen->method),
                        {.limit = chosen->limit, .tolerance = chosen->tolerance, .start = start});
  else
    dantzig_.solve(rows, {.start = start}, result);
  const int counted = chosen ? result.pivots : 0;
  if (result.status != lcp::Status::solved) return {false, result.residual, counted, result.status};
  for (Eigen::Index i = 0; i < n; ++i) {
    z[static_cast<std::size_t>(i)] = result.z[i];
    if (result.z[i] > 0) lcp::apply_impulse(bodies, contacts[static_cast<std::size_t>(i)], result.z[i]);
  }
  return {true, result.residual, counted, result.status};
}

IslandResult IslandSolver::solve_sparse(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                        std::span<const double> allowed, std::span<double> z,
                                        const IslandOptions& options) {
  rows_.begin(bodies);
  for (std::size_t i = 0; i < contacts.size(); ++i) rows_.add(contacts[i], allowed[i], z[i]);
  CrowdOptions sweeps;
  sweeps.most_sweeps = options.most_sweeps;
  sweeps.residual = options.residual;
  IslandResult result;
  result.residual = rows_.solve(sweeps, result.sweeps);
  result.solved = result.residual <= options.accepted;
  if (!result.solved) return result;
  for (std::size_t i = 0; i < contacts.size(); ++i) z[i] = rows_.impulse(static_cast<int>(i));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (bodies[k].is_static()) continue;
    bodies[k].velocity = rows_.velocity(static_cast<int>(k)).linear;
    bodies[k].spin = rows_.velocity(static_cast<int>(k)).angular;
  }
  return result;
}

}  // namespace fc::resting

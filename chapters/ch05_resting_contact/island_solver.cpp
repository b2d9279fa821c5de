#include "ch05_resting_contact/island_solver.hpp"

#include <algorithm>
#include <vector>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch03_impulse_lcp/solver.hpp"

namespace fc::resting {
namespace {

// The speed (m/s) of the fastest contact point, on either body.
double fastest(std::span<const RigidBody> bodies, std::span<const lcp::Contact> contacts) {
  double speed = 0;
  for (const lcp::Contact& c : contacts)
    for (const int body : {c.body_a, c.body_b})
      speed = std::max(speed, bodies[at(body)].velocity_at(c.point).norm());
  return speed;
}

bool has_moving_kinematic(std::span<const RigidBody> bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [](const RigidBody& body) {
    return body.is_static() && !(body.velocity.isZero(0) && body.spin.isZero(0));
  });
}

}  // namespace

// Where rounding defeats Dantzig's method (many nearly dependent rows), sweeps give an approximate solution.
void IslandSolver::sweep(std::span<const RigidBody> bodies, std::span<const lcp::Contact> contacts,
                         std::span<const double> approach_limits, std::span<const double> z,
                         lcp::LcpResult& result) {
  constexpr int kSweeps = 1000;
  constexpr double kAccepted = 1e-3;
  gauss_seidel_.clear();
  for (const RigidBody& body : bodies) {
    const Twist now{body.velocity, body.spin};
    gauss_seidel_.add_body(body, now, now);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i)
    gauss_seidel_.add(contacts[i], approach_limits[i], 0, z[i], 0);
  gauss_seidel_.run(1);
  gauss_seidel_.run_velocities(kSweeps);
  result.residual = gauss_seidel_.residual();
  if (!(result.residual <= kAccepted)) return;
  result.status = lcp::Status::solved;
  result.z.resize(static_cast<Eigen::Index>(contacts.size()));
  for (int i = 0; i < gauss_seidel_.rows(); ++i) result.z[i] = gauss_seidel_.impulse(i);
}

IslandResult IslandSolver::solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                 std::span<const double> approach_limits, std::span<double> z,
                                 const IslandOptions& options) {
  constexpr double kMostLeverage = 100;
  lcp::ImpactProblem problem = lcp::assemble(bodies, contacts);
  const auto n = static_cast<Eigen::Index>(contacts.size());
  problem.b += Eigen::Map<const VecX>(approach_limits.data(), n);
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
  }
  if (result.status != lcp::Status::solved && !options.chosen)
    sweep(bodies, contacts, approach_limits, z, result);
  const int steps = options.chosen ? result.pivots : 0;
  if (result.status != lcp::Status::solved) return {false, result.residual, steps, result.status};
  const std::vector<RigidBody> before(bodies.begin(), bodies.end());
  for (Eigen::Index i = 0; i < n; ++i)
    if (result.z[i] > 0) lcp::apply_impulse(bodies, contacts[at(i)], result.z[i]);
  if (has_moving_kinematic(bodies) && fastest(bodies, contacts) > kMostLeverage * fastest(before, contacts)) {
    std::copy(before.begin(), before.end(), bodies.begin());
    return {false, result.residual, steps, lcp::Status::limit};
  }
  Eigen::Map<VecX>(z.data(), n) = result.z;
  return {true, result.residual, steps, result.status};
}

}  // namespace fc::resting

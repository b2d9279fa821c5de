#include "ch05_resting_contact/island_solver.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {
IslandResult IslandSolver::solve(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                 std::span<const double> allowed, std::span<double> z,
                                 const IslandOptions& options) {
  if (static_cast<int>(contacts.size()) <= options.most_dense_rows) {
    const IslandResult dense = solve_dense(bodies, contacts, allowed, z);
    if (dense.solved) return dense;
  }
  return solve_sparse(bodies, contacts, allowed, z, options);
}

IslandResult IslandSolver::solve_dense(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                       std::span<const double> allowed, std::span<double> z) {
  lcp::ImpactProblem problem = lcp::assemble(bodies, contacts);
  const auto n = static_cast<Eigen::Index>(contacts.size());
  for (Eigen::Index i = 0; i < n; ++i) problem.b[i] += allowed[static_cast<std::size_t>(i)];
  const lcp::Lcp rows{problem.A, problem.b};
  const VecX guess = Eigen::Map<const VecX>(z.data(), n);
  lcp::LcpResult result;
  dantzig_.solve(rows, {.start = guess.maxCoeff() > 0 ? &guess : nullptr}, result);
  if (result.status != lcp::Status::solved) return {};
  for (Eigen::Index i = 0; i < n; ++i) {
    z[static_cast<std::size_t>(i)] = result.z[i];
    if (result.z[i] > 0) lcp::apply_impulse(bodies, contacts[static_cast<std::size_t>(i)], result.z[i]);
  }
  return {true, result.residual, 0};
}

// Of all rows at once, with the velocities as they are.
double IslandSolver::residual(std::span<const double> z, double scale) const {
  double worst = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    worst = std::max(worst, std::abs(std::min(rows_[i].diagonal * z[i], speed(rows_[i]))));
  return scale > 0 ? worst / scale : 0;
}

double IslandSolver::speed(const Row& row) const {
  const Twist &a = twists_[static_cast<std::size_t>(row.a)], &b = twists_[static_cast<std::size_t>(row.b)];
  return row.normal.dot(b.velocity - a.velocity) + row.arm_b.dot(b.spin) - row.arm_a.dot(a.spin) +
         row.allowed;
}

void IslandSolver::push(const Row& row, double impulse) {
  Twist &a = twists_[static_cast<std::size_t>(row.a)], &b = twists_[static_cast<std::size_t>(row.b)];
  a.velocity -= (impulse * row.inverse_a) * row.normal;
  a.spin -= impulse * row.turn_a;
  b.velocity += (impulse * row.inverse_b) * row.normal;
  b.spin += impulse * row.turn_b;
}

// One sweep of projected Gauss-Seidel; returns the sum of squares of what it changed, weighted by the
// diagonal: twice the energy, about, that it took away.
double IslandSolver::sweep(std::span<double> z) {
  double changed = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const double by = std::max(-z[i], -speed(row) * row.inverse_diagonal);
    if (by == 0) continue;
    push(row, by);
    z[i] += by;
    changed += row.diagonal * by * by;
  }
  return changed;
}

void IslandSolver::build_rows(std::span<const RigidBody> bodies, std::span<const lcp::Contact> contacts,
                              std::span<const double> allowed) {
  turns_.clear();
  twists_.clear();
  for (const RigidBody& body : bodies) {
    turns_.push_back(body.inverse_inertia_world());
    twists_.push_back({body.velocity, body.spin});
  }
  rows_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const lcp::Contact& c = contacts[i];
    const RigidBody &a = bodies[static_cast<std::size_t>(c.body_a)],
                    &b = bodies[static_cast<std::size_t>(c.body_b)];
    Row row;
    row.a = c.body_a;
    row.b = c.body_b;
    row.normal = c.normal;
    row.arm_a = c.turns_a ? Vec3((c.point - a.position).cross(c.normal)) : Vec3(Vec3::Zero());
    row.arm_b = c.turns_b ? Vec3((c.point - b.position).cross(c.normal)) : Vec3(Vec3::Zero());
    row.turn_a = turns_[static_cast<std::size_t>(c.body_a)] * row.arm_a;
    row.turn_b = turns_[static_cast<std::size_t>(c.body_b)] * row.arm_b;
    row.inverse_a = a.inverse_mass;
    row.inverse_b = b.inverse_mass;
    row.diagonal = row.inverse_a + row.inverse_b + row.arm_a.dot(row.turn_a) + row.arm_b.dot(row.turn_b);
    row.inverse_diagonal = 1 / row.diagonal;
    row.allowed = allowed[i];
    rows_.push_back(row);
  }
}

// Projected Gauss-Seidel, as the steps of nonlinear conjugate gradients (Silcowitz, Niebe, Erleben 2010):
// what a sweep changes is the gradient, and between sweeps the last direction is gone on with, as far as
// Fletcher and Reeves say. Starts anew where that does not help.
IslandResult IslandSolver::solve_sparse(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                        std::span<const double> allowed, std::span<double> z,
                                        const IslandOptions& options) {
  build_rows(bodies, contacts, allowed);
  double scale = 0;  // the largest |b|
  for (const Row& row : rows_) scale = std::max(scale, std::abs(speed(row)));
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (z[i] > 0) push(rows_[i], z[i]);

  IslandResult result;
  direction_.assign(z.size(), 0);
  along_.assign(twists_.size(), {Vec3::Zero(), Vec3::Zero()});
  double last = 0;
  while (true) {
    z_before_.assign(z.begin(), z.end());
    twists_before_ = twists_;
    const double changed = sweep(z);
    ++result.sweeps;
    const bool look = result.sweeps % options.look_every == 0 || changed == 0;
    if (look || result.sweeps >= options.most_sweeps) {
      result.residual = residual(z, scale);
      if (result.residual <= options.residual || result.sweeps >= options.most_sweeps || changed == 0) break;
    }
    const double go_on = last > 0 ? changed / last : 0;
    last = changed;
    if (go_on > 1) {
      std::fill(direction_.begin(), direction_.end(), 0.0);
      std::fill(along_.begin(), along_.end(), Twist{Vec3::Zero(), Vec3::Zero()});
      last = 0;
      continue;
    }
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double step = z[i] - z_before_[i];
      z[i] += go_on * direction_[i];
      direction_[i] = go_on * direction_[i] + step;
    }
    for (std::size_t k = 0; k < twists_.size(); ++k) {
      const Vec3 velocity = twists_[k].velocity - twists_before_[k].velocity,
                 spin = twists_[k].spin - twists_before_[k].spin;
      twists_[k].velocity += go_on * along_[k].velocity;
      twists_[k].spin += go_on * along_[k].spin;
      along_[k].velocity = go_on * along_[k].velocity + velocity;
      along_[k].spin = go_on * along_[k].spin + spin;
    }
  }
  result.solved = result.residual <= options.accepted;
  if (!result.solved) return result;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (bodies[k].is_static()) continue;
    bodies[k].velocity = twists_[k].velocity;
    bodies[k].spin = twists_[k].spin;
  }
  return result;
}

}  // namespace fc::resting

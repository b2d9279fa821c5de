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

IslandResult IslandSolver::solve_sparse(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                                        std::span<const double> allowed, std::span<double> z,
                                        const IslandOptions& options) {
  rows_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const lcp::Contact& c = contacts[i];
    Row row{-1, -1, c.normal, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0, 0, 0, allowed[i]};
    for (const bool on_b : {false, true}) {
      const int index = on_b ? c.body_b : c.body_a;
      const RigidBody& body = bodies[static_cast<std::size_t>(index)];
      if (body.is_static()) {
        row.fixed += (on_b ? 1 : -1) * c.normal.dot(body.velocity_at(c.point));
        continue;
      }
      (on_b ? row.b : row.a) = index;
      (on_b ? row.inverse_b : row.inverse_a) = body.inverse_mass;
      row.diagonal += body.inverse_mass;
      if (!(on_b ? c.turns_b : c.turns_a)) continue;
      const Vec3 arm = (c.point - body.position).cross(c.normal);
      const Vec3 turn = body.inverse_inertia_world() * arm;
      (on_b ? row.arm_b : row.arm_a) = arm;
      (on_b ? row.turn_b : row.turn_a) = turn;
      row.diagonal += arm.dot(turn);
    }
    rows_.push_back(row);
  }
  const std::vector<RigidBody> before(bodies.begin(), bodies.end());
  const auto speed = [&](const Row& row) {
    double w = row.fixed;
    if (row.a >= 0) {
      const RigidBody& a = bodies[static_cast<std::size_t>(row.a)];
      w -= row.normal.dot(a.velocity) + row.arm_a.dot(a.spin);
    }
    if (row.b >= 0) {
      const RigidBody& b = bodies[static_cast<std::size_t>(row.b)];
      w += row.normal.dot(b.velocity) + row.arm_b.dot(b.spin);
    }
    return w;
  };
  const auto change = [&](const Row& row, double impulse) {
    if (row.a >= 0) {
      RigidBody& a = bodies[static_cast<std::size_t>(row.a)];
      a.velocity -= (impulse * row.inverse_a) * row.normal;
      a.spin -= impulse * row.turn_a;
    }
    if (row.b >= 0) {
      RigidBody& b = bodies[static_cast<std::size_t>(row.b)];
      b.velocity += (impulse * row.inverse_b) * row.normal;
      b.spin += impulse * row.turn_b;
    }
  };
  double scale = 0;  // the largest |b|
  for (const Row& row : rows_) scale = std::max(scale, std::abs(speed(row)));
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (z[i] > 0) change(rows_[i], z[i]);

  // Of all rows at once, with the velocities as they are.
  const auto residual = [&] {
    double worst = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      worst = std::max(worst, std::abs(std::min(rows_[i].diagonal * z[i], speed(rows_[i]))));
    return scale > 0 ? worst / scale : 0;
  };
  IslandResult result;
  for (double changed = 1; result.sweeps < options.most_sweeps && changed > options.residual;) {
    ++result.sweeps;
    changed = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row& row = rows_[i];
      const double next = std::max(0.0, z[i] - speed(row) / row.diagonal), by = next - z[i];
      if (by == 0) continue;
      change(row, by);
      z[i] = next;
      changed = std::max(changed, row.diagonal * std::abs(by));
    }
    if (scale > 0) changed /= scale;
  }
  result.residual = residual();
  result.solved = result.residual <= options.accepted;
  if (!result.solved) std::copy(before.begin(), before.end(), bodies.begin());
  return result;
}

}  // namespace fc::resting

#include "ch06_friction/two_stage_impact.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fc::friction {
namespace {

// A residual of 1e-10 may leave an approach slower than this, relative to the velocities that cancel in it.
// Consequence: at 10 m/s two bodies may be left approaching at 1e-8 m/s.
constexpr double kApproachLeft = 1e-9;

void check(const FrictionImpact& impact, const FrictionImpactOptions& options) {
  check_arguments({impact.A, impact.u, impact.mu});
  const auto allowed = [](double e) { return e >= 0 && e <= 1; };
  if (impact.restitution.size() != impact.mu.size() ||
      !std::all_of(impact.restitution.begin(), impact.restitution.end(), allowed)) {
    throw std::invalid_argument("friction: " + std::to_string(impact.mu.size()) +
                                " restitutions in [0, 1] are needed, one for each contact");
  }
  if (options.max_passes < 2) {
    throw std::invalid_argument("friction: max_passes is " + std::to_string(options.max_passes) +
                                "; 2 or more are needed, since the last is without restitution");
  }
}

double fastest_approach(const VecX& u) {
  double fastest = 0;
  for (Eigen::Index row = 0; row < u.size(); row += 3) fastest = std::max(fastest, -u[row]);
  return fastest;
}

// The largest κ <= 1 with κ² r̂'Ar̂ <= r¹'Ar¹, where r̂ is what would be given back without a cap.
double cap_of(const MatX& A, const VecX& compression, const VecX& wanted) {
  const double stored = compression.dot(A * compression), returned = wanted.dot(A * wanted);
  return returned > stored ? std::sqrt(std::max(0.0, stored) / returned) : 1.0;
}

// The two stages from the velocities u, with given restitutions.
Status run_pass(const FrictionImpact& impact, const VecX& u, const VecX& restitution,
                const FrictionImpactOptions& options, ImpactPass& pass) {
  // Compression: no restitution.
  const ConeProblem problem{impact.A, u, impact.mu};
  const ConeResult first = solve(problem, options.method, options.solve);
  if (first.status != Status::solved) return first.status;
  pass.compression = first.r;
  pass.compressed = energy_change(problem, first.r);

  // What is given back, under the cap.
  VecX expansion = VecX::Zero(u.size()), radius(restitution.size());
  for (Eigen::Index i = 0; i < radius.size(); ++i) expansion[3 * i] = restitution[i] * first.r[3 * i];
  pass.cap = cap_of(impact.A, first.r, expansion);
  expansion *= pass.cap;

  // Friction against the expansion, and against the slip that is left.
  for (Eigen::Index i = 0; i < radius.size(); ++i) radius[i] = impact.mu[i] * expansion[3 * i];
  if (!radius.isZero(0)) {
    const VecX pushed = first.u + impact.A * expansion;
    const ConeResult friction = solve_discs(impact.A, pushed, radius, options.method, options.solve);
    if (friction.status != Status::solved) return friction.status;
    for (Eigen::Index i = 0; i < radius.size(); ++i)
      expansion.segment<2>(3 * i + 1) = friction.r.segment<2>(3 * i + 1);
  }
  pass.expansion = expansion;
  pass.expanded = energy_change({impact.A, first.u, impact.mu}, expansion);
  return Status::solved;
}

}  // namespace

ConeResult solve_discs(const MatX& A, const VecX& u, const VecX& radius, Method method,
                       const SolveOptions& options) {
  const Eigen::Index n = radius.size();
  const VecX none = VecX::Zero(n), one = VecX::Ones(n);
  const VecX scale = contact_scales({A, u, none});
  MatX discs = A;
  VecX b = u;
  for (Eigen::Index i = 0; i < n; ++i) {
    discs.row(3 * i).setZero();
    discs.col(3 * i).setZero();
    discs(3 * i, 3 * i) = scale[i];
    b[3 * i] = -scale[i] * radius[i];
  }
  SolveOptions from_nothing = options;
  from_nothing.start = nullptr;
  return solve({discs, b, one}, method, from_nothing);
}

FrictionImpactResult two_stage_impact(const FrictionImpact& impact, const FrictionImpactOptions& options) {
  check(impact, options);
  FrictionImpactResult result;
  result.r = VecX::Zero(impact.u.size());
  result.u = impact.u;
  VecX restitution = impact.restitution;
  double size = impact.u.size() > 0 ? impact.u.lpNorm<Eigen::Infinity>() : 0.0;
  while (static_cast<int>(result.passes.size()) < options.max_passes &&
         fastest_approach(result.u) > kApproachLeft * size) {
    if (static_cast<int>(result.passes.size()) == options.max_passes - 1) restitution.setZero();
    ImpactPass pass;
    result.status = run_pass(impact, result.u, restitution, options, pass);
    if (result.status != Status::solved) break;
    result.r += pass.compression + pass.expansion;
    result.u = lcp::evaluate(impact.A, impact.u, result.r);
    size = std::max(size, (impact.A.cwiseAbs() * result.r.cwiseAbs()).maxCoeff());
    result.passes.push_back(std::move(pass));
  }
  if (result.status == Status::solved && fastest_approach(result.u) > kApproachLeft * size)
    result.status = Status::limit;
  if (result.status != Status::solved) {
    result.r.setZero();
    result.u = impact.u;
  }
  result.energy_change = energy_change({impact.A, impact.u, impact.mu}, result.r);
  result.fastest_approach = fastest_approach(result.u);
  return result;
}

}  // namespace fc::friction

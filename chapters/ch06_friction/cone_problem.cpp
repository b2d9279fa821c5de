#include "ch06_friction/cone_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "ch06_friction/cone.hpp"

namespace fc::friction {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Relative to A's largest entry: with more asymmetry, A's two triangles are two different problems.
constexpr double kAsymmetry = 1e-10;
// A contact is strictly inside its cone if it lacks this share of µ r_N. Velocities below the second share of max|b|,
// and friction that changes velocities by less, have no direction but that of round-off.
constexpr double kInside = 1e-6;
constexpr double kSlides = 1e-6;

// The parts of residual() and acceptable(); a NaN remains one.
struct Measures {
  double violation = 0;  // m/s, the largest of any contact
  double b_size = 0;     // m/s, max|b|
  double ar_size = 0;    // m/s, max (|A||r|)
};

double nan_max(double a, double b) {
  return std::isnan(a) || a >= b ? a : b;
}

Measures measure(const ConeProblem& problem, const VecX& r, const VecX& u) {
  const VecX scale = contact_scales(problem);
  Measures m;
  for (Eigen::Index i = 0; i < problem.contacts(); ++i) {
    const double v = cone_violation(r.segment<3>(3 * i), u.segment<3>(3 * i), problem.mu[i], scale[i]);
    m.violation = nan_max(m.violation, v);
  }
  if (problem.contacts() == 0) return m;
  m.b_size = problem.b.lpNorm<Eigen::Infinity>();
  m.ar_size = (problem.A.cwiseAbs() * r.cwiseAbs()).maxCoeff();
  return m;
}

double ratio(const Measures& m) {
  return m.violation == 0 ? 0.0 : m.violation / nan_max(m.b_size, m.ar_size);
}

double largest_mu(const ConeProblem& problem) {
  return problem.contacts() > 0 ? problem.mu.maxCoeff() : 0.0;
}

double sum_rounding(const ConeProblem& problem) {
  return 8 * static_cast<double>(problem.b.size()) * kEpsilon;
}

bool in_cones(const ConeProblem& problem, const VecX& r) {
  for (Eigen::Index i = 0; i < problem.contacts(); ++i) {
    const double normal = r[3 * i], tangent = std::hypot(r[3 * i + 1], r[3 * i + 2]);
    if (!(normal >= 0 && tangent <= problem.mu[i] * normal * (1 + 8 * kEpsilon))) return false;
  }
  return true;
}

}  // namespace

void check_arguments(const ConeProblem& problem) {
  const Eigen::Index n = problem.contacts();
  if (problem.A.rows() != 3 * n || problem.A.cols() != 3 * n || problem.b.size() != 3 * n) {
    throw std::invalid_argument("friction: the matrix is " + std::to_string(problem.A.rows()) + " by " +
                                std::to_string(problem.A.cols()) + ", the vector has " +
                                std::to_string(problem.b.size()) + " entries, and there are " +
                                std::to_string(n) + " coefficients; 3n by 3n, 3n and n are needed");
  }
  if (!problem.A.allFinite() || !problem.b.allFinite() || !problem.mu.allFinite())
    throw std::invalid_argument(
        "friction: an entry of the matrix, the vector or the coefficients is not finite");
  for (Eigen::Index i = 0; i < n; ++i) {
    if (problem.mu[i] < 0) {
      throw std::invalid_argument("friction: contact " + std::to_string(i) + " has the coefficient " +
                                  std::to_string(problem.mu[i]) + "; >= 0 is needed");
    }
  }
}

bool is_suited(const ConeProblem& problem) {
  const Eigen::Index rows = problem.A.rows();
  if (rows == 0) return true;
  const double size = problem.A.cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < rows; ++j) {
    if (problem.A(j, j) < 0) return false;
    for (Eigen::Index i = j + 1; i < rows; ++i) {
      if (std::abs(problem.A(i, j) - problem.A(j, i)) > kAsymmetry * size) return false;
    }
  }
  return true;
}

VecX contact_scales(const ConeProblem& problem) {
  VecX scale(problem.contacts());
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const double size = problem.A.block<3, 3>(3 * i, 3 * i).cwiseAbs().maxCoeff();
    scale[i] = size > 0 ? size : 1.0;
  }
  return scale;
}

double residual(const ConeProblem& problem, const VecX& r, const VecX& u) {
  return ratio(measure(problem, r, u));
}

double residual_rounding(const ConeProblem& problem) {
  return sum_rounding(problem) * (1 + largest_mu(problem));
}

PhysicalErrors physical_errors(const ConeProblem& problem, const VecX& r, const VecX& u) {
  PhysicalErrors errors;
  if (problem.contacts() == 0) return errors;
  const double slow = kSlides * problem.b.lpNorm<Eigen::Infinity>();
  const VecX scale = contact_scales(problem);
  for (Eigen::Index i = 0; i < problem.contacts(); ++i) {
    const double bound = problem.mu[i] * r[3 * i];
    const Eigen::Vector2d friction = r.segment<2>(3 * i + 1), slip = u.segment<2>(3 * i + 1);
    errors.approach = std::max(errors.approach, -u[3 * i]);
    errors.cone_excess = std::max(errors.cone_excess, friction.norm() - bound);
    if (scale[i] * bound <= slow) continue;
    if (friction.norm() < (1 - kInside) * bound) {
      errors.creep = std::max(errors.creep, slip.norm());
    } else if (slip.norm() > slow) {
      const double cross = friction[0] * slip[1] - friction[1] * slip[0];
      errors.angle = std::max(errors.angle, std::abs(std::atan2(cross, -friction.dot(slip))));
    }
  }
  return errors;
}

bool acceptable(const ConeProblem& problem, const VecX& r, const VecX& u) {
  if (r.size() != problem.b.size() || u.size() != problem.b.size()) return false;
  if (!r.allFinite() || !u.allFinite() || !in_cones(problem, r)) return false;
  const Measures m = measure(problem, r, u);
  const double rounding = sum_rounding(problem) * m.ar_size;
  const VecX again = lcp::evaluate(problem.A, problem.b, r);
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    if (!(std::abs(u[i] - again[i]) <= rounding + 8 * kEpsilon * std::abs(problem.b[i]))) return false;
  }
  // Written so that an overflow, which makes a measure infinite, gives false.
  return rounding <= 1e-3 * m.b_size && m.violation <= 1e-6 * m.b_size + (1 + largest_mu(problem)) * rounding;
}

double energy_change(const ConeProblem& problem, const VecX& r) {
  return r.dot(problem.b) + 0.5 * r.dot(problem.A * r);
}

void judge(const ConeProblem& problem, const VecX& r, double tolerance, Status otherwise,
           ConeResult& result) {
  result.r = r;
  result.u = lcp::evaluate(problem.A, problem.b, r);
  result.residual = residual(problem, result.r, result.u);
  const bool small = result.residual <= std::max(tolerance, residual_rounding(problem));
  result.status = small && acceptable(problem, result.r, result.u) ? Status::solved : otherwise;
}

}  // namespace fc::friction

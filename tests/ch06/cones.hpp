// Random frictional contact problems, and answers that share no code with the solvers.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch06_friction/cone_problem.hpp"
#include "tests/ch03/bodies.hpp"

namespace fc::friction {

// A problem that owns its numbers.
struct OwnProblem {
  MatX A;
  VecX b, mu;

  operator ConeProblem() const { return {A, b, mu}; }
};

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline MatX random_matrix(std::mt19937_64& random, Eigen::Index rows, Eigen::Index columns) {
  MatX matrix(rows, columns);
  for (double& entry : matrix.reshaped()) entry = uniform(random, -1, 1);
  return matrix;
}

// n contacts between bodies that have `freedom` coordinates together, whose inverse masses spread over
// `decades`: A = J M⁻¹ J' is of rank <= freedom, and b = J v is a motion that the bodies can have.
inline OwnProblem random_problem(std::mt19937_64& random, Eigen::Index n, Eigen::Index freedom, double mu,
                                 double decades = 0) {
  const MatX J = random_matrix(random, 3 * n, freedom);
  VecX inverse_mass(freedom), v(freedom);
  for (double& m : inverse_mass) m = std::pow(10.0, uniform(random, -decades, 0));
  for (double& speed : v) speed = uniform(random, -1, 1);
  OwnProblem p{J * inverse_mass.asDiagonal() * J.transpose(), J * v, VecX::Constant(n, mu)};
  p.A = 0.5 * (p.A + p.A.transpose()).eval();
  return p;
}

// The frictional problem of a heap: chapter 3's matrix of three directions a contact.
inline OwnProblem heap_problem(const lcp::Heap& heap, double mu) {
  std::vector<lcp::Contact> rows;
  for (const lcp::Contact& contact : heap.contacts) {
    const Vec3 t1 = contact.normal.unitOrthogonal();
    for (const Vec3& direction : {contact.normal, t1, Vec3(contact.normal.cross(t1))}) {
      rows.push_back(contact);
      rows.back().normal = direction.normalized();
      rows.back().restitution = 0;
    }
  }
  const lcp::ImpactProblem problem = lcp::assemble(heap.bodies, rows);
  return {problem.A, problem.b, VecX::Constant(static_cast<Eigen::Index>(heap.contacts.size()), mu)};
}

// How far (r, u) is from Signorini's and Coulomb's laws, as they are said in words; shares nothing with
// cone_violation(). m/s. A speed beside a force counts, whichever is the smaller.
inline double broken_law(const ConeProblem& p, const VecX& r, const VecX& u) {
  double worst = 0;
  for (Eigen::Index i = 0; i < p.contacts(); ++i) {
    const double s = p.block(i).cwiseAbs().maxCoeff(), push = s * r[3 * i];
    const Eigen::Vector2d friction = s * r.segment<2>(3 * i + 1), slip = u.segment<2>(3 * i + 1);
    const double spare = p.mu[i] * push - friction.norm();
    worst = std::max({worst, -u[3 * i], -push, -spare});  // no approach, no pull, in the cone
    worst = std::max(worst, std::min(std::abs(u[3 * i]), std::abs(push)));  // pushes only where it touches
    worst = std::max(worst, std::min(slip.norm(), spare));                  // slips only on the cone
    const Eigen::Vector2d sum = friction.norm() * slip + slip.norm() * friction;  // against the slip
    if (slip.norm() + friction.norm() > 0)
      worst = std::max(worst, sum.norm() / (slip.norm() + friction.norm()));
  }
  return worst;
}

// max(max|b|, max |A||r|), what a residual is measured against.
inline double size_of(const ConeProblem& p, const VecX& r) {
  return std::max(p.b.lpNorm<Eigen::Infinity>(), (p.A.cwiseAbs() * r.cwiseAbs()).maxCoeff());
}

// Painlevé's rod: an end of a uniform rod of mass 1 and half-length 1 that slides on the floor, tan θ = 2. For a
// µ > 4/3 friction presses it down faster than it is pushed up. q = (-normal approach, slip, 0).
inline Mat3 painleve_block() {
  return Mat3{{1.6, -1.2, 0}, {-1.2, 3.4, 0}, {0, 0, 1}};
}

// All answers of one contact whose slip roots a fine sampling tells from each other: open, stick, slip by slip.
// f is evaluated from A itself: u_N = 0 and u_T = -α r_T are three linear equations.
inline std::vector<Vec3> all_answers(const Mat3& A, const Vec3& q, double mu, int samples) {
  std::vector<Vec3> answers;
  if (q[0] >= 0) answers.emplace_back(Vec3::Zero());
  const auto at = [&](double alpha) -> Vec3 {
    Mat3 shifted = A;
    shifted(1, 1) += alpha;
    shifted(2, 2) += alpha;
    return shifted.inverse() * -q;
  };
  const auto excess = [&](double alpha) {
    const Vec3 r = at(alpha);
    return std::hypot(r[1], r[2]) - mu * r[0];
  };
  if (excess(0) <= 0) answers.push_back(at(0));
  const double trace = A(1, 1) + A(2, 2);
  const auto alpha_of = [&](int k) { return trace * k / (samples + 1e-9 - k); };
  for (int k = 0; k < samples; ++k) {
    double low = alpha_of(k), high = alpha_of(k + 1);
    const bool outside = excess(low) > 0;
    if (outside == (excess(high) > 0)) continue;
    for (int h = 0; h < 80; ++h) {
      const double middle = 0.5 * (low + high);
      ((excess(middle) > 0) == outside ? low : high) = middle;
    }
    answers.push_back(at(0.5 * (low + high)));
  }
  return answers;
}

}  // namespace fc::friction

// Random frictional contact problems, and answers that share no code with the solvers.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "ch06_friction/cone_problem.hpp"

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

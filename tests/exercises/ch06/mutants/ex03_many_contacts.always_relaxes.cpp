// Caught by: Ex06ManyContacts.RandomProblems
// Halves its steps after every 50 sweeps, also where they go well.
#include "ex03_many_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::exercises {
namespace {

constexpr int kWatch = 50;
constexpr double kProgress = 0.95, kLeastRelaxation = 1. / 16;

// The nearest point of the cone.
Vec3 project(const Vec3& x, double mu) {
  const double slip = x.tail<2>().norm();
  if (slip <= mu * x[0]) return x;
  if (mu * slip <= -x[0]) return Vec3::Zero();
  const double normal = (x[0] + mu * slip) / (1 + mu * mu);
  Vec3 nearest(normal, 0, 0);
  if (slip > 0) nearest.tail<2>() = mu * normal / slip * x.tail<2>();
  return nearest;
}

}  // namespace

double residual(const Problem& problem, const VecX& r) {
  const VecX u = problem.A * r + problem.b;
  const VecX parts = problem.A.cwiseAbs() * r.cwiseAbs();
  const double size = std::max(problem.b.lpNorm<Eigen::Infinity>(), parts.lpNorm<Eigen::Infinity>());
  if (size == 0) return 0;
  double worst = 0;
  for (Eigen::Index i = 0; i < problem.mu.size(); ++i) {
    const double mu = problem.mu[i], s = problem.A.block<3, 3>(3 * i, 3 * i).cwiseAbs().maxCoeff();
    const Vec3 now = r.segment<3>(3 * i);
    Vec3 shifted = u.segment<3>(3 * i);
    shifted[0] += mu * shifted.tail<2>().norm();
    worst = std::max(worst, s * (now - project(now - shifted / s, mu)).norm());
  }
  return worst / size;
}

Result solve(const Problem& problem, double tolerance, int most) {
  const Eigen::Index count = problem.mu.size();
  Result result;
  result.r = VecX::Zero(3 * count);
  double smallest = std::numeric_limits<double>::infinity(), watched = smallest;
  while (true) {
    result.residual = residual(problem, result.r);
    result.solved = result.residual <= tolerance;
    if (result.solved || result.sweeps >= most) return result;
    smallest = std::min(smallest, result.residual);
    if (result.sweeps > 0 && result.sweeps % kWatch == 0) {
      if (smallest <= watched) result.relaxation = std::max(0.5 * result.relaxation, kLeastRelaxation);
      watched = smallest;
    }
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::Index i = result.sweeps % 2 == 0 ? k : count - 1 - k;
      const Mat3 block = problem.A.block<3, 3>(3 * i, 3 * i);
      const Vec3 old = result.r.segment<3>(3 * i);
      const Vec3 u = problem.A.middleRows<3>(3 * i) * result.r + problem.b.segment<3>(3 * i);
      const Vec3 now = one_contact(block, u - block * old, problem.mu[i]);
      result.r.segment<3>(3 * i) += result.relaxation * (now - old);
    }
    ++result.sweeps;
  }
}

double heat(const Problem& problem, const VecX& r) {
  const VecX u = problem.A * r + problem.b;
  double sum = 0;
  for (Eigen::Index i = 0; i < problem.mu.size(); ++i)
    sum -= r.segment<2>(3 * i + 1).dot(u.segment<2>(3 * i + 1));
  return sum;
}

}  // namespace fc::exercises

#include "ch06_friction/boxed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch06_friction/start.hpp"

namespace fc::friction {
namespace {

constexpr int kBoxRounds = 50;
constexpr double kSettled = 1e-12;

// One LCP over the normals, and over the tangents that have a bound > 0 and can move something.
class Boxes {
 public:
  explicit Boxes(const ConeProblem& problem) : problem_(problem) {}
  // radius: n, N s. Sets r, 3n, from a solved LCP. Returns the LCP's status.
  Status solve(const VecX& radius, VecX& r);
  int pivots() const { return pivots_; }

 private:
  const ConeProblem& problem_;
  lcp::DantzigSolver solver_;
  lcp::LcpResult answer_;
  int pivots_ = 0;
};

Status Boxes::solve(const VecX& radius, VecX& r) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < problem_.contacts(); ++i) {
    rows.push_back(3 * i);
    for (Eigen::Index row = 3 * i + 1; row < 3 * i + 3; ++row) {
      const bool idle = problem_.b[row] == 0 && problem_.A.row(row).isZero(0);
      if (radius[i] > 0 && !idle) rows.push_back(row);
    }
  }
  const auto size = static_cast<Eigen::Index>(rows.size());
  const MatX A = problem_.A(rows, rows);
  const VecX b = problem_.b(rows);
  VecX lower(size), upper(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::Index row = rows[static_cast<std::size_t>(k)];
    const bool normal = row % 3 == 0;
    upper[k] = normal ? std::numeric_limits<double>::infinity() : radius[row / 3];
    lower[k] = normal ? 0.0 : -radius[row / 3];
  }
  solver_.solve({A, b, &lower, &upper}, {}, answer_);
  pivots_ += answer_.pivots;
  if (answer_.status != Status::solved) return answer_.status;
  r.setZero();
  r(rows) = answer_.z;
  return Status::solved;
}

}  // namespace

ConeResult solve_frictionless(const ConeProblem& problem, const SolveOptions& options) {
  ConeResult result;
  if (refused(problem, options, result)) return result;
  const VecX none = VecX::Zero(problem.contacts());
  VecX r = VecX::Zero(problem.b.size());
  Boxes boxes(problem);
  const Status status = boxes.solve(none, r);
  judge({problem.A, problem.b, none}, r, options.tolerance, Status::limit, result);
  if (status != Status::solved) result.status = status;
  result.pivots = boxes.pivots();
  return result;
}

ConeResult solve_boxed(const ConeProblem& problem, const SolveOptions& options) {
  ConeResult result;
  if (refused(problem, options, result)) return result;
  const int limit = options.limit > 0 ? options.limit : kBoxRounds;
  const VecX scale = contact_scales(problem);
  VecX radius = VecX::Zero(problem.contacts()), r = VecX::Zero(problem.b.size());
  Boxes boxes(problem);
  Status status = boxes.solve(radius, r);
  int rounds = 0;
  for (bool settled = false; status == Status::solved && !settled && rounds < limit; ++rounds) {
    const VecX before = r;
    for (Eigen::Index i = 0; i < radius.size(); ++i) radius[i] = problem.mu[i] * r[3 * i];
    status = boxes.solve(radius, r);
    settled = true;
    for (Eigen::Index i = 0; i < radius.size(); ++i) {
      const double change = scale[i] * std::abs(r[3 * i] - before[3 * i]);
      settled = settled && change <= kSettled * problem.b.lpNorm<Eigen::Infinity>();
    }
  }
  // The bounds came from the round before; those of these normals differ in the last digits.
  for (Eigen::Index row = 0; row < r.size(); ++row) {
    const double bound = problem.mu[row / 3] * r[row - row % 3];
    if (row % 3 != 0) r[row] = std::clamp(r[row], -bound, bound);
  }
  judge(problem, r, options.tolerance, Status::limit, result);
  if (status != Status::solved) result.status = status;
  result.sweeps = rounds;
  result.pivots = boxes.pivots();
  return result;
}

}  // namespace fc::friction

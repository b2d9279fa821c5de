#include "ch06_friction/gauss_seidel.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "ch06_friction/cone.hpp"
#include "ch06_friction/one_contact.hpp"
#include "ch06_friction/start.hpp"

namespace fc::friction {
namespace {

constexpr int kSweeps = 2000;
// Sweeps between two recomputations of u: increments accumulate round-off.
constexpr int kRefreshEvery = 25;
// This many sweeps must bring the smallest violation below this share of its former value, or ω is halved.
constexpr int kWatch = 50;
constexpr double kProgress = 0.95;
constexpr double kLeastRelaxation = 1.0 / 16;

class GaussSeidel {
 public:
  GaussSeidel(const ConeProblem& problem, VecX start);
  void sweep(bool forwards, double relaxation);
  void refresh();
  double residual() const;
  const VecX& impulses() const { return r_; }

 private:
  const ConeProblem& problem_;
  std::vector<OneContact> contacts_;
  VecX scale_, r_, u_;
  double size_ = 0;  // m/s, the residual's denominator at the last refresh
};

GaussSeidel::GaussSeidel(const ConeProblem& problem, VecX start)
    : problem_(problem), scale_(contact_scales(problem)), r_(std::move(start)), u_(r_.size()) {
  for (Eigen::Index i = 0; i < problem.contacts(); ++i)
    contacts_.emplace_back(problem.block(i), problem.mu[i]);
  refresh();
}

void GaussSeidel::refresh() {
  u_ = problem_.b;
  u_.noalias() += problem_.A * r_;
  size_ = problem_.b.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < r_.size(); ++i)
    size_ = std::max(size_, problem_.A.col(i).cwiseAbs().dot(r_.cwiseAbs()));
}

void GaussSeidel::sweep(bool forwards, double relaxation) {
  const Eigen::Index n = problem_.contacts();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index i = forwards ? k : n - 1 - k;
    const auto columns = problem_.A.middleCols<3>(3 * i);
    const Vec3 old = r_.segment<3>(3 * i);
    const Vec3 without = u_.segment<3>(3 * i) - columns.middleRows<3>(3 * i) * old;
    Vec3 next = contacts_[static_cast<std::size_t>(i)].solve(without);
    if (relaxation < 1) next = (1 - relaxation) * old + relaxation * next;
    if (next == old) continue;
    u_.noalias() += columns * (next - old);
    r_.segment<3>(3 * i) = next;
  }
}

double GaussSeidel::residual() const {
  double worst = 0;
  for (Eigen::Index i = 0; i < problem_.contacts(); ++i) {
    const double v = cone_violation(r_.segment<3>(3 * i), u_.segment<3>(3 * i), problem_.mu[i], scale_[i]);
    worst = std::max(worst, v);
  }
  return size_ > 0 ? worst / size_ : 0.0;
}

}  // namespace

ConeResult solve_gauss_seidel(const ConeProblem& problem, const SolveOptions& options) {
  ConeResult result;
  if (refused(problem, options, result)) return result;
  const int limit = options.limit > 0 ? options.limit : kSweeps;
  GaussSeidel method(problem, start_in_cones(problem, options.start));
  double smallest = std::numeric_limits<double>::infinity(), watched = smallest;
  while (true) {
    const double now = method.residual();
    smallest = std::min(smallest, now);
    if (now <= options.tolerance || result.sweeps == limit) {
      judge(problem, method.impulses(), options.tolerance, Status::limit, result);
      if (result.status == Status::solved || result.sweeps == limit) return result;
    }
    if (result.sweeps > 0 && result.sweeps % kWatch == 0) {
      if (smallest > kProgress * watched)
        result.relaxation = std::max(0.5 * result.relaxation, kLeastRelaxation);
      watched = smallest;
    }
    method.sweep(result.sweeps % 2 == 0, result.relaxation);
    ++result.sweeps;
    if (result.sweeps % kRefreshEvery == 0) method.refresh();
  }
}

}  // namespace fc::friction

#include "ch03_impulse_lcp/interior_point.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "ch03_impulse_lcp/active_set.hpp"

namespace fc::lcp {
namespace {

constexpr int kNewtonSteps = 100;
// The share of the distance to the boundary that a step may take.
constexpr double kBack = 0.995;

// The longest step <= 1 that keeps v + step dv >= 0.
double longest_step(const VecX& v, const VecX& dv) {
  double step = 1;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    if (dv[i] < 0) step = std::min(step, -v[i] / dv[i]);
  }
  return step;
}

// (A + diag(w / z)) x = r, by Cholesky where A is symmetric.
class StepSystem {
 public:
  explicit StepSystem(const MatX& A) : A_(A), symmetric_(A == A.transpose()) {}

  bool factor(const VecX& z, const VecX& w) {
    M_ = A_;
    M_.diagonal() += w.cwiseQuotient(z);
    if (!M_.allFinite()) return false;
    if (symmetric_) {
      llt_.compute(M_);
      return llt_.info() == Eigen::Success;
    }
    lu_.compute(M_);
    return true;
  }
  VecX solve(const VecX& r) const { return symmetric_ ? VecX(llt_.solve(r)) : VecX(lu_.solve(r)); }

 private:
  const MatX& A_;
  bool symmetric_;
  MatX M_;
  Eigen::LLT<MatX> llt_;
  Eigen::PartialPivLU<MatX> lu_;
};

}  // namespace

LcpResult solve_interior_point(const Lcp& problem, const SolveOptions& options) {
  check_arguments(problem);
  if (problem.boxed()) return refused(problem, Status::unsuited);
  const Eigen::Index n = problem.size();
  LcpResult result = refused(problem, Status::solved);
  const double tolerance = options.tolerance > 0 ? options.tolerance : kUsualResidual;
  if (n == 0 || problem.b.minCoeff() >= 0) return result;

  // Rows are scaled to a diagonal near 1, as in Dantzig's method; z and w begin at the size of b.
  VecX scale(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (problem.A(i, i) < 0) return refused(problem, Status::unsuited);
    scale[i] = problem.A(i, i) > 0 ? std::exp2(std::round(0.5 * std::log2(problem.A(i, i)))) : 1.0;
  }
  MatX A = problem.A;
  for (Eigen::Index j = 0; j < n; ++j) A.col(j) = A.col(j).cwiseQuotient(scale) / scale[j];
  const VecX b = problem.b.cwiseQuotient(scale);
  const double size = b.lpNorm<Eigen::Infinity>();
  VecX z = VecX::Constant(n, size), w = z;

  StepSystem system(A);
  const int limit = options.limit > 0 ? options.limit : kNewtonSteps;
  int step = 0;
  for (; step < limit; ++step) {
    const VecX r = A * z + b - w;
    const double mu = z.dot(w) / static_cast<double>(n);
    if (!system.factor(z, w)) {
      result.status = step == 0 ? Status::unsuited : Status::limit;
      break;
    }
    // Predict: aim straight at the corner, mu = 0. Then correct for the products that this would leave.
    VecX dz = system.solve(-r - w);
    VecX dw = -w - w.cwiseQuotient(z).cwiseProduct(dz);
    const double predicted = std::min(longest_step(z, dz), longest_step(w, dw));
    const double mu_predicted = (z + predicted * dz).dot(w + predicted * dw) / static_cast<double>(n);
    const double centring = std::pow(std::max(0.0, mu_predicted / mu), 3);
    const VecX target = (VecX::Constant(n, centring * mu) - dz.cwiseProduct(dw)).cwiseQuotient(z) - w;
    dz = system.solve(target - r);
    dw = target - w.cwiseQuotient(z).cwiseProduct(dz);
    const double length = std::min(1.0, kBack * std::min(longest_step(z, dz), longest_step(w, dw)));
    z += length * dz;
    w += length * dw;
    if (!z.allFinite() || !w.allFinite() || z.minCoeff() <= 0 || w.minCoeff() <= 0) {
      result.status = Status::limit;
      ++step;
      break;
    }

    // The result of z for the problem itself; also without the impulses of rows that separate.
    VecX pushing = z.cwiseQuotient(scale);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (z[i] < w[i]) pushing[i] = 0;
    }
    LcpResult inside = judged(problem, z.cwiseQuotient(scale), Status::solved);
    LcpResult cut = judged(problem, pushing, Status::solved);
    result = cut.residual < inside.residual ? std::move(cut) : std::move(inside);
    if (result.status == Status::solved && result.residual <= tolerance) {
      ++step;
      break;
    }
    result.status = Status::limit;
    result.certificate = no_solution_certificate(problem, z.cwiseQuotient(scale));
    if (result.certificate.size() > 0) {
      result.status = Status::no_solution;
      ++step;
      break;
    }
  }
  result.pivots = step;
  if (result.status == Status::solved || result.status == Status::limit) {
    std::vector<int> active;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (z[i] >= w[i]) active.push_back(static_cast<int>(i));
    }
    polish(problem, active, result);
    if (result.residual > tolerance) result.status = Status::limit;
  }
  return result;
}

}  // namespace fc::lcp

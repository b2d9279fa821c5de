#include "ch03_impulse_lcp/projected_gauss_seidel.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/active_set.hpp"

namespace fc::lcp {
namespace {

constexpr int kSweeps = 10000;
constexpr int kLookEverySweeps = 10;

// A row without entries: no z changes its w. False if no z is complementary to that w.
bool settle_zero_row(const Lcp& problem, Eigen::Index i, VecX& z) {
  z[i] = problem.b[i] > 0 ? problem.low(i) : problem.b[i] < 0 ? problem.high(i) : z[i];
  const bool exists = std::isfinite(z[i]);
  if (!exists) z[i] = 0;
  return exists;
}

}  // namespace

LcpResult solve_pgs(const Lcp& problem, const SolveOptions& options) {
  check_arguments(problem);
  const Eigen::Index n = problem.size();
  const MatX& A = problem.A;
  const int limit = options.limit > 0 ? options.limit : kSweeps;
  const double tolerance = options.tolerance > 0 ? options.tolerance : kUsualResidual;

  VecX z = VecX::Zero(n);
  if (options.start != nullptr) z = *options.start;
  for (Eigen::Index i = 0; i < n; ++i) {
    z[i] = std::clamp(z[i], problem.low(i), problem.high(i));
    if (A(i, i) > 0) continue;
    if (!A.row(i).isZero(0)) return refused(problem, Status::unsuited);
    if (settle_zero_row(problem, i, z)) continue;
    LcpResult result = refused(problem, Status::no_solution);
    result.certificate = (problem.b[i] < 0 ? 1 : -1) * VecX::Unit(n, i);
    return result;
  }

  // A sweep goes along the rows of A. They are the columns of its transpose, which are contiguous in memory.
  const MatX rows = A.transpose();
  const VecX inverse = A.diagonal().cwiseInverse();
  LcpResult result = judged(problem, z, Status::solved);
  if (result.status == Status::solved && result.residual <= tolerance) return result;
  for (int sweep = 1; sweep <= limit; ++sweep) {
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!(A(i, i) > 0)) continue;
      const double w = problem.b[i] + rows.col(i).dot(z);
      z[i] = std::clamp(z[i] - w * inverse[i], problem.low(i), problem.high(i));
    }
    if (sweep % kLookEverySweeps != 0 && sweep != limit) continue;
    result = judged(problem, z, Status::solved);
    result.pivots = sweep;
    if (result.status == Status::solved && result.residual <= tolerance) return result;
  }
  result.status = Status::limit;
  return result;
}

}  // namespace fc::lcp

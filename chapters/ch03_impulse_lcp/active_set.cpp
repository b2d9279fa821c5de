#include "ch03_impulse_lcp/active_set.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

namespace fc::lcp {

LcpResult judged(const Lcp& problem, VecX z, Status status) {
  LcpResult result;
  const bool finite = z.allFinite();
  result.z = finite ? std::move(z) : VecX(VecX::Zero(problem.size()));
  const Verdict verdict = Verifier().judge(problem, result.z, result.w);
  result.residual = verdict.residual;
  result.status = status == Status::solved && !(finite && verdict.acceptable) ? Status::limit : status;
  return result;
}

LcpResult refused(const Lcp& problem, Status status) {
  return judged(problem, VecX::Zero(problem.size()), status);
}

namespace {

// z of the active rows with w = 0 there, by any decomposition.
template <class Decomposition>
VecX solved_for(const Lcp& problem, const std::vector<int>& active) {
  const Decomposition block(MatX(problem.A(active, active)));
  VecX z = VecX::Zero(problem.size());
  for (int round = 0; round < 2; ++round) {
    const VecX w = evaluate(problem.A, problem.b, z);
    z(active) -= block.solve(VecX(w(active)));
    if (!z.allFinite()) break;
  }
  return z;
}

}  // namespace

void polish(const Lcp& problem, const std::vector<int>& active, LcpResult& result) {
  if (active.empty()) return;
  const auto try_this = [&](VecX z) {
    if (!z.allFinite()) return false;
    LcpResult polished = judged(problem, z.cwiseMax(0.0), Status::solved);
    if (polished.status != Status::solved || !(polished.residual < result.residual)) return false;
    polished.pivots = result.pivots;
    result = std::move(polished);
    return true;
  };
  if (!try_this(solved_for<Eigen::PartialPivLU<MatX>>(problem, active))) {
    try_this(solved_for<Eigen::CompleteOrthogonalDecomposition<MatX>>(problem, active));
  }
}

}  // namespace fc::lcp

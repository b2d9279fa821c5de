#include "ch03_impulse_lcp/dantzig.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include "ch03_impulse_lcp/dantzig_core.hpp"

namespace fc::lcp {
namespace {

// A Schur complement near zero is either a zero with round-off or a true small value; to confuse the two
// makes impulses huge, or leaves a row violated. No threshold is right for all matrices. But the order of the
// rows decides which nearly dependent rows meet, a longer arithmetic tells more of them apart, and a coarser
// threshold keeps more of them out. So a solve that fails, or whose residual is above kGoodResidual, is
// repeated with these settings, in this order, and the best result counts.
struct Trial {
  detail::Attempt attempt;
  bool extended;  // in long double
};
constexpr std::array<Trial, 12> kTrials = {{{{1, true, false}, false},
                                            {{1, false, false}, false},
                                            {{1, false, true}, false},
                                            {{1, false, false}, true},
                                            {{1, false, true}, true},
                                            {{1e2, false, false}, false},
                                            {{1e2, false, true}, false},
                                            {{1e3, false, false}, true},
                                            {{1e4, false, false}, false},
                                            {{1e4, false, true}, false},
                                            {{1e6, false, false}, false},
                                            {{1e6, false, true}, false}}};
constexpr double kGoodResidual = 1e-12;
// Above this residual, or this error, a solved basis is refined as long as it improves, at most kRefinements
// times. Plain double arithmetic gives a residual of about epsilon sqrt(n); the error is |A||z| / |b| times
// that.
constexpr double kRefined = 4e-15;
constexpr double kRefinedError = 2e-14;
constexpr int kRefinements = 2;
// After this many steps of z, each with its round-off, one solve of the basis restores its digits.
constexpr int kSteps = 16;

}  // namespace

struct DantzigSolver::Memory {
  detail::DantzigCore<double> plain;
  std::unique_ptr<detail::DantzigCore<long double>> extended;  // made when it is needed
  Verifier verifier;
  LcpResult trial;
};

DantzigSolver::DantzigSolver() : memory_(std::make_unique<Memory>()) {}
DantzigSolver::~DantzigSolver() = default;
DantzigSolver::DantzigSolver(DantzigSolver&&) noexcept = default;
DantzigSolver& DantzigSolver::operator=(DantzigSolver&&) noexcept = default;

namespace {

// One trial, verified.
template <class Real>
void run_trial(detail::DantzigCore<Real>& core, Verifier& verifier, const Lcp& problem,
               const detail::Attempt& attempt, const VecX* start, int max_pivots, LcpResult& result) {
  result.status = core.solve(attempt, start, max_pivots);
  core.impulses(result.z);
  Verdict verdict = verifier.judge(problem, result.z, result.w);
  const auto good = [&] { return verdict.residual <= kRefined && verdict.error <= kRefinedError; };
  if (result.status == Status::solved && (!good() || core.steps_since_solved() > kSteps)) {
    result.status = core.improve();
    core.impulses(result.z);
    verdict = verifier.judge(problem, result.z, result.w);
  }
  result.pivots = core.pivots();
  for (int k = 0; k < kRefinements && result.status == Status::solved && !good(); ++k) {
    const VecX z = result.z, w = result.w;
    const bool inside = core.refine();
    core.impulses(result.z);
    const Verdict refined = verifier.judge(problem, result.z, result.w);
    if (!inside || !(refined.error < verdict.error)) {
      result.z = z;
      result.w = w;
      break;
    }
    verdict = refined;
  }
  result.residual = verdict.residual;
  if (result.status == Status::no_solution) result.certificate = core.certificate();
  if (!result.z.allFinite() ||
      !result.w.allFinite()) {  // an overflow: numbers near 1e300, or a hopeless matrix
    result.z.setZero();
    verdict = verifier.judge(problem, result.z, result.w);
    result.residual = verdict.residual;
    verdict.acceptable = false;
  }
  if (result.status == Status::solved && !verdict.acceptable) {
    result.status = core.indefinite() ? Status::unsuited : Status::limit;
  }
}

// A row whose w is negative for every z >= 0, because its part of A is <= 0, shows that there is no solution;
// -1: no such row.
Eigen::Index hopeless_row(const Lcp& problem) {
  if (problem.boxed()) return -1;
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    if (problem.b[i] < 0 && problem.A.row(i).maxCoeff() <= 0) return i;
  }
  return -1;
}

}  // namespace

void DantzigSolver::solve(const Lcp& problem, const DantzigOptions& options, LcpResult& result) {
  check_arguments(problem);
  if (options.start != nullptr && options.start->size() != problem.size()) {
    throw std::invalid_argument("LCP: the guess has " + std::to_string(options.start->size()) +
                                " entries, the problem " + std::to_string(problem.size()) + " rows");
  }
  result.certificate.resize(0);
  Memory& memory = *memory_;
  if (!memory.plain.load(problem)) {
    result.z = VecX::Zero(problem.size());
    result.residual = memory.verifier.judge(problem, result.z, result.w).residual;
    const Eigen::Index hopeless = hopeless_row(problem);
    result.status = hopeless >= 0 ? Status::no_solution : Status::unsuited;
    if (hopeless >= 0) result.certificate = VecX::Unit(problem.size(), hopeless);
    result.pivots = 0;
    return;
  }
  const int limit = options.max_pivots > 0 ? options.max_pivots : 100 + 50 * static_cast<int>(problem.size());
  int pivots = 0;
  bool first = true;
  for (const Trial& t : kTrials) {
    if (!first && pivots >= limit) break;
    detail::Attempt attempt = t.attempt;
    attempt.predict = attempt.predict && options.predict;
    const VecX* start = first ? options.start : nullptr;
    LcpResult& trial = first ? result : memory.trial;
    if (t.extended) {
      if (!memory.extended) memory.extended = std::make_unique<detail::DantzigCore<long double>>();
      memory.extended->load(problem);
      run_trial(*memory.extended, memory.verifier, problem, attempt, start, limit - pivots, trial);
    } else {
      run_trial(memory.plain, memory.verifier, problem, attempt, start, limit - pivots, trial);
    }
    pivots += trial.pivots;
    if (!first && trial.status == Status::solved &&
        (result.status != Status::solved || trial.residual < result.residual)) {
      std::swap(result, trial);
    }
    first = false;
    if (result.status == Status::solved && result.residual <= kGoodResidual) break;
    if (trial.status == Status::no_solution || result.status == Status::no_solution) {
      if (result.status == Status::solved) break;
      if (result.status != Status::no_solution) result.certificate = trial.certificate;
      result.status = Status::no_solution;
      break;
    }
  }
  result.pivots = pivots;
}

LcpResult solve_dantzig(const Lcp& problem, const DantzigOptions& options) {
  LcpResult result;
  DantzigSolver().solve(problem, options, result);
  return result;
}

}  // namespace fc::lcp

// What accuracy costs (a point for pivoting methods, a curve for iterative ones), and what a fixed time
// achieves.
#include "ch03_impulse_lcp/study/parts.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::lcp {
namespace {

constexpr std::array kStudied = {Family::random_spd, Family::spd_1e8, Family::rank_deficient,
                                 Family::box_heap,   Family::stack,   Family::stack_1e8};
constexpr std::array kBudgets = {1e5, 1e6, 1e7};  // ns

// A tolerance that is never reached: only its limit stops an iterative method.
constexpr double kNever = 1e-300;

// Up to 10,000 sweeps, fewer where n is so large that the picture would take minutes.
std::vector<int> limits(Method method, Eigen::Index n) {
  constexpr double kMostProducts = 1e8;  // of sweeps times n^2
  if (method == Method::pgs) {
    std::vector<int> sweeps;
    for (const int k : {1, 3, 10, 30, 100, 300, 1000, 3000, 10'000})
      if (k * static_cast<double>(n * n) <= kMostProducts) sweeps.push_back(k);
    return sweeps;
  }
  if (method == Method::interior_point) return {1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 30};
  return {0};
}

// The residual of z = 0, that of a method that has not finished. At most 1.
double residual_of_nothing(const KnownProblem& p) {
  return residual(p.lcp(), VecX::Zero(p.b.size()), p.b);
}

void measure(Family family, const std::vector<KnownProblem>& problems, TableWriter& accuracy,
             TableWriter& budget) {
  const Eigen::Index n = problems.front().b.size();
  std::vector<double> nothing;
  for (const KnownProblem& p : problems) nothing.push_back(residual_of_nothing(p));
  for (const Method method : kMethods) {
    std::array<double, kBudgets.size()> best;
    best.fill(median(nothing));
    bool suited = false;
    for (const int limit : limits(method, n)) {
      Tally tally;
      for (const KnownProblem& p : problems)
        tally.add(
            p, timed_solve(p.lcp(), method, {.limit = limit, .tolerance = iterative(method) ? kNever : 0}));
      if (tally.work.empty()) continue;
      suited = true;
      const double work = median(tally.work), reached = median(tally.residual), ns = median(tally.ns);
      accuracy.row({std::string(name(family)), std::int64_t{n}, std::string(name(method)),
                    std::int64_t{limit}, static_cast<std::int64_t>(problems.size()),
                    std::int64_t{tally.solved}, work, products(method, work, n), reached, median(tally.error),
                    ns});
      for (std::size_t k = 0; k < kBudgets.size(); ++k)
        if (ns <= kBudgets[k]) best[k] = std::min(best[k], reached);
    }
    if (!suited) continue;
    budget.row({std::string(name(family)), std::int64_t{n}, std::string(name(method)), median(nothing),
                best[0], best[1], best[2]});
  }
}

}  // namespace

void study_accuracy(const StudyOptions& options) {
  TableWriter accuracy(options.out / "accuracy.csv", {{"family", ""},
                                                      {"rows", ""},
                                                      {"method", ""},
                                                      {"limit", ""},
                                                      {"problems", ""},
                                                      {"solved", ""},
                                                      {"work", ""},
                                                      {"products", ""},
                                                      {"residual", ""},
                                                      {"error", ""},
                                                      {"median_ns", ""}});
  TableWriter budget(options.out / "budget.csv", {{"family", ""},
                                                  {"rows", ""},
                                                  {"method", ""},
                                                  {"residual_at_0", ""},
                                                  {"residual_in_100000_ns", ""},
                                                  {"residual_in_1000000_ns", ""},
                                                  {"residual_in_10000000_ns", ""}});
  std::vector<int> sizes;
  for (const int n : {32, 96, 256})
    if (n <= options.rows) sizes.push_back(n);
  if (sizes.empty()) sizes.push_back(16);
  Progress progress("accuracy", static_cast<std::int64_t>(kStudied.size() * sizes.size()), options.quiet);
  std::int64_t done = 0;
  for (const int n : sizes)
    for (const Family family : kStudied) {
      std::vector<KnownProblem> problems;
      // The largest problems cost most, and differ least.
      const int count = n > 96 ? (options.seeds + 1) / 2 : options.seeds;
      for (int seed = 1; seed <= count; ++seed)
        problems.push_back(make_problem(family, n, static_cast<std::uint64_t>(seed)));
      measure(family, problems, accuracy, budget);
      progress.update(++done);
    }
  accuracy.close();
  budget.close();
}

}  // namespace fc::lcp

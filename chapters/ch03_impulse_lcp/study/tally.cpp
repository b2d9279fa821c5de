// How the study solves, times and counts.
#include <algorithm>
#include <chrono>

#include "ch03_impulse_lcp/study/parts.hpp"

namespace fc::lcp {

Timed timed_solve(const Lcp& problem, Method method, const SolveOptions& options) {
  constexpr std::size_t kRepetitions = 5;
  constexpr double kEnough = 2e7;  // ns
  Timed timed;
  std::vector<double> times;
  double total = 0;
  while (times.size() < kRepetitions && total < kEnough) {
    const auto start = std::chrono::steady_clock::now();
    timed.result = solve(problem, method, options);
    const auto end = std::chrono::steady_clock::now();
    times.push_back(static_cast<double>((end - start) / std::chrono::nanoseconds(1)));
    total += times.back();
  }
  timed.ns = median(times);
  return timed;
}

void Tally::add(const KnownProblem& problem, const Timed& timed) {
  const LcpResult& result = timed.result;
  if (result.status == Status::unsuited) return;
  solved += result.status == Status::solved;
  work.push_back(result.pivots);
  residual.push_back(result.residual);
  error.push_back((result.w - problem.w).lpNorm<Eigen::Infinity>() / problem.b.lpNorm<Eigen::Infinity>());
  ns.push_back(timed.ns);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double products(Method method, double work, Eigen::Index n) {
  return method == Method::interior_point ? work * static_cast<double>(n) / 3 : work;
}

bool iterative(Method method) {
  return method == Method::pgs || method == Method::interior_point;
}

}  // namespace fc::lcp

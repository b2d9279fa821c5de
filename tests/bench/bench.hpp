// What the benchmarks of all chapters share: times of single queries, and the counters of contract 1.6.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace fc::bench {

// What a method did with a case's queries.
struct Verdict {
  int misses = 0;  // no hit where there is one
  int late = 0;    // a time after the true first contact
  int failed = 0;  // no answer, or a wrong distance
};

inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Times `query(i)` for i = 0 ... count - 1. Each query is run so often in a row that neither the clock's own
// cost nor a cold cache shows, and all of them `repetitions` times; a query's time is the median of its
// repetitions.
template <class Query>
std::vector<double> times_ns(int count, int repetitions, const Query& query) {
  using Clock = std::chrono::steady_clock;
  std::vector<int> in_a_row(static_cast<std::size_t>(count), 1);
  std::vector<std::vector<double>> times(static_cast<std::size_t>(count));
  for (int repetition = -1; repetition < repetitions; ++repetition)  // the first one warms up and calibrates
    for (int i = 0; i < count; ++i) {
      const int times_in_a_row = in_a_row[i];
      const auto start = Clock::now();
      for (int k = 0; k < times_in_a_row; ++k) query(i);
      const double ns =
          std::chrono::duration<double, std::nano>(Clock::now() - start).count() / times_in_a_row;
      if (repetition < 0)
        in_a_row[i] = std::clamp(static_cast<int>(8000 / std::max(ns, 1.0)), 4, 64);
      else
        times[i].push_back(ns);
    }
  std::vector<double> medians;
  for (const auto& t : times) medians.push_back(median_of(t));
  return medians;
}

// Registers the row `case/who`: its queries' times and its verdict. `query(i)` answers query i and returns
// something that the compiler must not drop; `judge()` compares every answer with the truth, once.
template <class Query, class Judge>
void add_row(const std::string& name, int count, const Query& query, const Judge& judge) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    int next = 0;
    for (auto _ : state) {  // Google Benchmark's own column: the mean over the queries, one after the other
      benchmark::DoNotOptimize(query(next));
      next = next + 1 < count ? next + 1 : 0;
    }
    std::vector<double> times = times_ns(count, 5, [&](int i) { benchmark::DoNotOptimize(query(i)); });
    const Verdict verdict = judge();
    std::sort(times.begin(), times.end());
    state.counters["median_ns"] = times[times.size() / 2];
    state.counters["p95_ns"] = times[times.size() * 95 / 100];
    state.counters["misses"] = verdict.misses;
    state.counters["late"] = verdict.late;
    state.counters["failed"] = verdict.failed;
  });
}

}  // namespace fc::bench

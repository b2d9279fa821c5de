// What the benchmarks of all chapters share: times of single queries, and the counters of contract 1.6.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace fc::bench {

// What a method did with a case's queries.
struct Verdict {
  int misses = 0;                           // no hit where there is one
  int late = 0;                             // a time after the true first contact
  int failed = 0;                           // no answer, or a wrong one
  std::map<std::string, double> more = {};  // further counters of the row
};

// How often each query is timed.
struct Effort {
  int repetitions = 5;     // of the whole set of queries, after a first one that warms up
  int least_in_a_row = 4;  // of one query, in each repetition
  int most_in_a_row = 64;
};

inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Times `query(i)` for i = 0 ... count - 1. Each query is repeated in a row (within the effort's limits) until neither
// the clock's own cost nor a cold cache matters, and all of them `repetitions` times; a query's
// time is the median of its repetitions.
template <class Query>
std::vector<double> times_ns(int count, const Effort& effort, const Query& query) {
  using Clock = std::chrono::steady_clock;
  std::vector<int> in_a_row(static_cast<std::size_t>(count), 1);
  std::vector<std::vector<double>> times(static_cast<std::size_t>(count));
  for (int repetition = -1; repetition < effort.repetitions; ++repetition)  // the first one calibrates
    for (int i = 0; i < count; ++i) {
      const int times_in_a_row = in_a_row[i];
      const auto start = Clock::now();
      for (int k = 0; k < times_in_a_row; ++k) query(i);
      const double ns =
          std::chrono::duration<double, std::nano>(Clock::now() - start).count() / times_in_a_row;
      if (repetition < 0)
        in_a_row[i] = std::clamp(static_cast<int>(8000 / std::max(ns, 1.0)), effort.least_in_a_row,
                                 effort.most_in_a_row);
      else
        times[i].push_back(ns);
    }
  std::vector<double> medians;
  for (const auto& t : times) medians.push_back(median_of(t));
  return medians;
}

// A row of a case, ready to be run: `query(i)` answers query i and returns something that the compiler must not
// optimise away; `judge()` compares every answer with the truth, once.
template <class Query, class Judge>
struct Row {
  int count = 0;
  Query query;
  Judge judge;
};
template <class Query, class Judge>
Row(int, Query, Judge) -> Row<Query, Judge>;

// Registers the row `case/who`: its queries' times and its verdict. `make()` returns the Row; it is called
// when the row is run, so that rows that a filter leaves out cost nothing.
template <class Make>
void add_row_when_run(const std::string& name, const Effort& effort, const Make& make) {
  struct Result {
    std::vector<double> times;  // ascending
    Verdict verdict;
  };
  const auto result = std::make_shared<Result>();  // kept: Google Benchmark runs a function several times
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const auto row = make();
    if (result->times.empty()) {
      result->times = times_ns(row.count, effort, [&](int i) { benchmark::DoNotOptimize(row.query(i)); });
      std::sort(result->times.begin(), result->times.end());
      result->verdict = row.judge();
    }
    int next = 0;
    for (auto _ : state) {  // Google Benchmark's own column: the mean over the queries, one after the other
      benchmark::DoNotOptimize(row.query(next));
      next = next + 1 < row.count ? next + 1 : 0;
    }
    state.counters["median_ns"] = result->times[result->times.size() / 2];
    state.counters["p95_ns"] = result->times[result->times.size() * 95 / 100];
    state.counters["misses"] = result->verdict.misses;
    state.counters["late"] = result->verdict.late;
    state.counters["failed"] = result->verdict.failed;
    for (const auto& [counter, value] : result->verdict.more) state.counters[counter] = value;
  });
}

template <class Query, class Judge>
void add_row(const std::string& name, int count, const Query& query, const Judge& judge) {
  add_row_when_run(name, {}, [=] { return Row{count, query, judge}; });
}

}  // namespace fc::bench

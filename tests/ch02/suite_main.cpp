// ch02_suite: as many random queries as you like, each answer checked against the reference.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

#include "common/program.hpp"
#include "suite.hpp"

namespace {

using fc::ca::Status;

struct Totals {
  std::map<Status, std::uint64_t> of;
  std::uint64_t queries = 0, limited = 0, undecided = 0, wrong = 0;
  std::int64_t looks = 0;
  double asked = 0, checked = 0, slowest = 0;  // s

  void add(const Totals& other) {
    for (const auto& [status, n] : other.of) of[status] += n;
    queries += other.queries;
    limited += other.limited;
    undecided += other.undecided;
    wrong += other.wrong;
    looks += other.looks;
    asked += other.asked;
    checked += other.checked;
    slowest = std::max(slowest, other.slowest);
  }
  void add(const suite::Verdict& v) {
    add({{{v.status, 1}},
         1,
         v.limited ? 1u : 0u,
         v.undecided ? 1u : 0u,
         v.wrong.empty() ? 0u : 1u,
         v.looks,
         v.asked,
         v.checked,
         v.asked + v.checked});
  }
  std::string row(const std::string& name) {
    const double n = static_cast<double>(std::max<std::uint64_t>(1, queries));
    return fmt::format(
        "{:12}{:>9}{:>9}{:>10}{:>9}{:>12}{:>11}{:>9}{:>10}{:>7}{:>12.0f}{:>10.2f}{:>10.2f}{:>10.2f}\n", name,
        queries, of[Status::contact], of[Status::separated], of[Status::touching_at_start],
        of[Status::penetrating_at_start], of[Status::unresolved] - limited, limited, undecided, wrong,
        static_cast<double>(looks) / n, 1e3 * asked / n, 1e3 * checked / n, slowest);
  }
  static std::string header() {
    return fmt::format("{:12}{:>9}{:>9}{:>10}{:>9}{:>12}{:>11}{:>9}{:>10}{:>7}{:>12}{:>10}{:>10}{:>10}\n",
                       "story", "queries", "contact", "separated", "touching", "penetrating", "unresolved",
                       "limited", "undecided", "wrong", "looks/query", "asked/ms", "check/ms", "longest/s");
  }
};

struct Named {
  std::string name;  // of the row that it counts for
  suite::Query query;
};
using Source = std::function<Named(std::uint64_t)>;

// Each worker has its own source of queries; numbers are handed out `share` at a time.
Totals run(std::uint64_t first, std::uint64_t queries, std::uint64_t share, unsigned threads,
           const std::string& again, const std::function<Source()>& source) {
  std::map<std::string, Totals> totals;
  std::mutex door;
  std::atomic<std::uint64_t> next{0};
  fc::Progress progress("queries", static_cast<std::int64_t>(queries), false);
  const auto work = [&] {
    const Source query_of = source();
    for (std::uint64_t begin; (begin = next.fetch_add(share)) < queries;) {
      std::map<std::string, Totals> sums;
      std::string text;
      for (std::uint64_t number = first + begin; number < first + std::min(queries, begin + share);
           ++number) {
        const Named named = query_of(number);
        const suite::Verdict v = suite::check(named.query);
        sums[named.name].add(v);
        if (!v.wrong.empty() || v.undecided)
          text += fmt::format("query {} ({}, {} against {}, {}): {}; again: {} --first {}\n", number,
                              named.name, named.query.a->what, named.query.b->what, name_of(v.status),
                              v.wrong.empty() ? "undecided" : v.wrong, again, number);
      }
      const std::lock_guard lock(door);
      for (const auto& [name, t] : sums) totals[name].add(t);
      fmt::print(stderr, "{}", text);
      progress.update(static_cast<std::int64_t>(begin));
    }
  };
  std::vector<std::thread> team;
  for (unsigned i = 0; i < threads; ++i) team.emplace_back(work);
  for (std::thread& t : team) t.join();

  fmt::print("{}", Totals::header());
  Totals all;
  for (auto& [name, t] : totals) {
    all.add(t);
    fmt::print("{}", t.row(name));
  }
  fmt::print("{}", all.row("all"));
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t queries = 20'000, bunnies = 0, seed = 1, first = 0;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  CLI::App app(
      "Random queries of chapter 2, each answer checked against a slow reference in long double. Ends with 1 "
      "if any is wrong. The same seed and number make the same query on any machine with the same standard "
      "library.");
  app.add_option("--queries", queries, "How many, of random meshes")->capture_default_str();
  app.add_option("--bunny", bunnies, "Instead: how many, of two bunnies of 69,666 triangles");
  app.add_option("--seed", seed, "Of the suite")->capture_default_str();
  app.add_option("--first", first, "The number of the first one: to go on, or to look at one again")
      ->capture_default_str();
  app.add_option("--threads", threads, "How many work at it")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  Totals all;
  if (bunnies > 0) {
    const std::shared_ptr<const suite::Prepared> bunny = suite::bunny();
    if (!bunny) {
      fmt::print("skipped: the bunny is not there\n");
      return 0;
    }
    all = run(first, bunnies, 1, threads, fmt::format("ch02_suite --bunny 1 --seed {}", seed), [&] {
      return [&](std::uint64_t number) {
        return Named{name_of(suite::approach_of(number)), suite::query_of_one_mesh(bunny, seed, number)};
      };
    });
  } else {
    all = run(first, queries, suite::kStories.size(), threads,
              fmt::format("ch02_suite --queries 1 --seed {}", seed), [&] {
                return [source = std::make_shared<suite::Queries>(seed)](std::uint64_t number) {
                  return Named{name_of(suite::story_of(number)), source->at(number)};
                };
              });
  }
  return all.wrong == 0 ? 0 : 1;
}

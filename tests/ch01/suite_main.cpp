// ch01_suite: as many random queries as you like, each answer checked against the reference.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <map>
#include <mutex>
#include <thread>

#include "common/program.hpp"
#include "suite.hpp"

namespace {

using fc::ca::Status;

struct Totals {
  std::map<Status, std::uint64_t> of;
  std::uint64_t queries = 0, uncertified = 0, undecided = 0, wrong = 0, looks = 0;

  void add(const suite::Verdict& v) {
    ++queries;
    ++of[v.status];
    uncertified += v.uncertified ? 1 : 0;
    undecided += v.undecided ? 1 : 0;
    wrong += v.wrong.empty() ? 0 : 1;
    looks += static_cast<std::uint64_t>(v.looks);
  }
  void add(const Totals& other) {
    for (const auto& [status, n] : other.of) of[status] += n;
    queries += other.queries;
    uncertified += other.uncertified;
    undecided += other.undecided;
    wrong += other.wrong;
    looks += other.looks;
  }
  std::string row(const std::string& name) {
    return fmt::format("{:12}{:>10}{:>10}{:>10}{:>10}{:>12}{:>11}{:>12}{:>10}{:>7}{:>12.1f}\n", name, queries,
                       of[Status::contact], of[Status::separated], of[Status::touching_at_start],
                       of[Status::penetrating_at_start], of[Status::unresolved], uncertified, undecided,
                       wrong,
                       static_cast<double>(looks) / static_cast<double>(std::max<std::uint64_t>(1, queries)));
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t queries = 100'000, seed = 1, first = 0;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  CLI::App app(
      "Random queries of chapter 1, each answer checked against a slow reference in long double. Ends with 1 "
      "if any is wrong. The same seed and number make the same query on any machine with the same standard "
      "library.");
  app.add_option("--queries", queries, "How many")->capture_default_str();
  app.add_option("--seed", seed, "Of the suite")->capture_default_str();
  app.add_option("--first", first, "The number of the first one: to go on, or to look at one again")
      ->capture_default_str();
  app.add_option("--threads", threads, "How many work at it")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::map<suite::Story, Totals> totals;
  std::mutex door;
  std::atomic<std::uint64_t> next{0};
  fc::Progress progress("queries", static_cast<std::int64_t>(queries), false);
  const auto work = [&] {
    constexpr std::uint64_t kShare = 256;
    for (std::uint64_t begin; (begin = next.fetch_add(kShare)) < queries;) {
      std::map<suite::Story, Totals> share;
      std::string wrong;
      for (std::uint64_t i = begin; i < std::min(queries, begin + kShare); ++i) {
        const std::uint64_t number = first + i;
        const suite::Verdict v = suite::check(suite::query_of(seed, number), number);
        share[suite::story_of(number)].add(v);
        if (!v.wrong.empty())
          wrong += fmt::format("query {} of seed {} ({}): {}\n", number, seed,
                               name_of(suite::story_of(number)), v.wrong);
      }
      const std::lock_guard lock(door);
      for (const auto& [story, t] : share) totals[story].add(t);
      fmt::print(stderr, "{}", wrong);
      progress.update(static_cast<std::int64_t>(begin));
    }
  };
  std::vector<std::thread> team;
  for (unsigned i = 0; i < threads; ++i) team.emplace_back(work);
  for (std::thread& t : team) t.join();

  fmt::print("{:12}{:>10}{:>10}{:>10}{:>10}{:>12}{:>11}{:>12}{:>10}{:>7}{:>12}\n", "story", "queries",
             "contact", "separated", "touching", "penetrating", "unresolved", "uncertified", "undecided",
             "wrong", "looks/query");
  Totals all;
  for (auto& [story, t] : totals) {
    all.add(t);
    fmt::print("{}", t.row(name_of(story)));
  }
  fmt::print("{}", all.row("all"));
  return all.wrong == 0 ? 0 : 1;
}

// Every method on a few hundred problems, for performance profiles (Dolan and More 2002).
#include "ch03_impulse_lcp/study/parts.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::lcp {
namespace {

// Symmetric positive semidefinite, mixed active sets: within the class of every method.
constexpr std::array kProfiled = {Family::random_spd, Family::spd_1e4,        Family::spd_1e8,
                                  Family::degenerate, Family::rank_deficient, Family::duplicate_contacts,
                                  Family::stack,      Family::stack_1e4,      Family::stack_1e8,
                                  Family::tower_1e8,  Family::chain_1e8,      Family::ball_heap,
                                  Family::box_heap};

constexpr double kTolerance = 1e-8;  // asked of the iterative methods, and of every answer
constexpr int kMostSweeps = 10'000;

}  // namespace

void study_profiles(const StudyOptions& options) {
  TableWriter table(options.out / "profiles.csv", {{"family", ""},
                                                   {"rows", ""},
                                                   {"seed", ""},
                                                   {"method", ""},
                                                   {"status", ""},
                                                   {"good", ""},
                                                   {"work", ""},
                                                   {"products", ""},
                                                   {"residual", ""},
                                                   {"median_ns", ""}});
  std::vector<int> sizes;
  for (const int n : {8, 16, 32, 64, 128})
    if (n <= options.rows) sizes.push_back(n);
  Progress progress("profiles", static_cast<std::int64_t>(kProfiled.size() * sizes.size()), options.quiet);
  std::int64_t done = 0;
  for (const Family family : kProfiled)
    for (const int n : sizes) {
      for (int seed = 1; seed <= options.seeds; ++seed) {
        const KnownProblem p = make_problem(family, n, static_cast<std::uint64_t>(seed));
        for (const Method method : kMethods) {
          SolveOptions solve_options;
          if (iterative(method)) solve_options.tolerance = kTolerance;
          if (method == Method::pgs) solve_options.limit = kMostSweeps;
          const Timed timed = timed_solve(p.lcp(), method, solve_options);
          const LcpResult& r = timed.result;
          if (r.status == Status::unsuited) continue;
          const bool good = r.status == Status::solved && r.residual <= kTolerance;
          table.row({std::string(name(family)), std::int64_t{n}, std::int64_t{seed},
                     std::string(name(method)), std::string(name(r.status)), std::int64_t{good},
                     std::int64_t{r.pivots}, products(method, r.pivots, n), r.residual, timed.ns});
        }
      }
      progress.update(++done);
    }
  table.close();
}

}  // namespace fc::lcp

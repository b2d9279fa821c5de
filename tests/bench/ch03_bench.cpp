// Chapter 3 beside Bullet: linear complementarity problems of the problem factory, ten of each case. `failed`
// counts those that were not solved to a residual of 1e-10 (contract 1.5), whatever the solver says of them.
// Where all rows are active the LCP is a linear system, and Eigen's Cholesky decomposition of the same matrix
// is the limit. ODE's solver, of which Bullet's is a port, cannot be called from outside its library: it
// takes memory of a private class.
#include <Eigen/Cholesky>
#include <algorithm>
#include <memory>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/problem_factory.hpp"
#include "ch03_impulse_lcp/solver.hpp"
#include "tests/bench/bench.hpp"
#include "tests/bench/ch03_bullet.hpp"

namespace {

using namespace fc;
using namespace fc::bench;
using namespace fc::lcp;

constexpr int kProblems = 10;
constexpr double kResidual = 1e-10;

using Problems = std::shared_ptr<const std::vector<KnownProblem>>;

Problems problems_of(Family family, Eigen::Index n) {
  auto problems = std::make_shared<std::vector<KnownProblem>>();
  for (int seed = 1; seed <= kProblems; ++seed)
    problems->push_back(make_problem(family, n, static_cast<std::uint64_t>(seed)));
  return problems;
}

bool right(const Lcp& problem, const VecX& z) {
  const VecX w = evaluate(problem.A, problem.b, z);
  // A peer may leave z at -1e-17: values that are negative within round-off count as zero.
  const VecX clean = z.cwiseMax(0.0);
  return z.allFinite() && acceptable(problem, clean, evaluate(problem.A, problem.b, clean)) &&
         residual(problem, z, w) <= kResidual;
}

// What one solver returns for a problem: z, and how many pivots, sweeps or steps it took (0: not known).
struct Answer {
  bool says_solved = false;
  VecX z;
  int pivots = 0;
};

// A row: `solver(problem, answer)` for each problem; Make gives it memory of its own.
template <class Make>
void add(const std::string& name, Family family, Eigen::Index n, const Effort& effort, const Make& make) {
  add_row_when_run(name, effort, [=] {
    const Problems problems = problems_of(family, n);
    const auto answers = std::make_shared<std::vector<Answer>>(kProblems);
    const auto solver = make();
    const auto query = [=](int i) {
      solver((*problems)[static_cast<std::size_t>(i)], (*answers)[static_cast<std::size_t>(i)]);
      return (*answers)[static_cast<std::size_t>(i)].pivots;
    };
    const auto judge = [=] {
      bench::Verdict verdict;
      double pivots = 0;
      for (int i = 0; i < kProblems; ++i) {
        const Answer& answer = (*answers)[static_cast<std::size_t>(i)];
        const bool good =
            answer.says_solved && right((*problems)[static_cast<std::size_t>(i)].lcp(), answer.z);
        verdict.failed += good ? 0 : 1;
        pivots += static_cast<double>(answer.pivots) / kProblems;
      }
      verdict.more["solved"] = kProblems - verdict.failed;
      verdict.more["pivots"] = pivots;
      return verdict;
    };
    return Row{kProblems, query, judge};
  });
}

enum class Guess { none, all, planted };

void add_ours(const std::string& name, Family family, Eigen::Index n, const Effort& effort, bool predict,
              Guess guess) {
  add(name, family, n, effort, [=] {
    const auto solver = std::make_shared<DantzigSolver>();
    const auto result = std::make_shared<LcpResult>();
    const auto all = std::make_shared<VecX>(VecX::Ones(n));
    return [=](const KnownProblem& p, Answer& answer) {
      const VecX* start = guess == Guess::all ? all.get() : guess == Guess::planted ? &p.z : nullptr;
      solver->solve(p.lcp(), {.start = start, .predict = predict}, *result);
      answer = {result->status == Status::solved, result->z, result->pivots};
    };
  });
}

void add_method(const std::string& name, Family family, Eigen::Index n, const Effort& effort, Method method) {
  add(name, family, n, effort, [=] {
    return [=](const KnownProblem& p, Answer& answer) {
      LcpResult result = solve(p.lcp(), method);
      answer = {result.status == Status::solved, std::move(result.z), result.pivots};
    };
  });
}

void add_bullet(const std::string& name, Family family, Eigen::Index n, const Effort& effort,
                bool (BulletLcp::*solve)(const MatX&, const VecX&, VecX&)) {
  add(name, family, n, effort, [=] {
    const auto bullet = std::make_shared<BulletLcp>();
    return [=](const KnownProblem& p, Answer& answer) {
      answer.says_solved = (*bullet.*solve)(p.A, p.b, answer.z);
      answer.pivots = 0;
    };
  });
}

void add_llt(const std::string& name, Family family, Eigen::Index n, const Effort& effort) {
  add(name, family, n, effort, [=] {
    const auto llt = std::make_shared<Eigen::LLT<MatX>>(n);
    return [=](const KnownProblem& p, Answer& answer) {
      llt->compute(p.A);
      answer = {llt->info() == Eigen::Success, llt->solve(-p.b), 0};
    };
  });
}

void add_case(const std::string& name, Family family, Eigen::Index n) {
  const Effort fast{5, 1, 64}, slow{3, 1, 4}, slowest{1, 1, 1};
  const Effort& ours = n >= 256 ? slow : fast;
  const Effort& theirs = n >= 128 ? slowest : fast;
  add_ours(name + "/ours", family, n, ours, true, Guess::none);
  add_ours(name + "/ours_row_by_row", family, n, ours, false, Guess::none);
  add_bullet(name + "/bullet_dantzig", family, n, theirs, &BulletLcp::dantzig);
  if (n <= 128) add_bullet(name + "/bullet_lemke", family, n, theirs, &BulletLcp::lemke);
  add_bullet(name + "/bullet_pgs", family, n, slowest, &BulletLcp::pgs);
  add_method(name + "/ours_lemke", family, n, theirs, Method::lemke);
  add_method(name + "/ours_pgs", family, n, slowest, Method::pgs);
  add_method(name + "/ours_interior_point", family, n, theirs, Method::interior_point);
}

}  // namespace

int main(int argc, char** argv) {
  for (const int n : {8, 32, 128, 512}) add_case("spd_" + std::to_string(n), Family::random_spd, n);
  for (const int n : {8, 32, 128, 512}) {
    const std::string name = "all_active_" + std::to_string(n);
    const Effort effort{5, 1, n >= 256 ? 4 : 64};
    add_llt(name + "/eigen_llt", Family::all_active, n, effort);
    add_ours(name + "/ours", Family::all_active, n, effort, true, Guess::none);
    add_ours(name + "/ours_all_guessed", Family::all_active, n, effort, true, Guess::all);
    add_ours(name + "/ours_row_by_row", Family::all_active, n, effort, false, Guess::none);
    add_bullet(name + "/bullet_dantzig", Family::all_active, n, {1, 1, 1}, &BulletLcp::dantzig);
  }
  for (const int n : {8, 32, 128, 512}) {  // with the last step's impulses as the guess: a different question
    add_ours("warm_" + std::to_string(n) + "/ours", Family::random_spd, n, {5, 1, n >= 256 ? 4 : 64}, true,
             Guess::planted);
  }
  for (const int n : {8, 32, 128, 512})
    add_case("corners_" + std::to_string(n), Family::duplicate_contacts, n);
  for (const int boxes : {10, 50}) add_case("stack_" + std::to_string(boxes), Family::stack, 4 * boxes);
  add_case("ratio_1e4", Family::stack_1e4, 40);
  add_case("ratio_1e8", Family::stack_1e8, 40);
  add_case("heap_96", Family::box_heap, 96);
  add_case("rank_half_128", Family::rank_deficient, 128);

  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// Demo of exercise 3.4: how your drives end on six families of problems whose answer is known, 200 of each.
// Writes ends.csv.
#include <cstdio>
#include <filesystem>

#include "ch03_impulse_lcp/problem_factory.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex04_lost_solutions.hpp"

namespace {

using namespace fc;

// The verdict on an answer, in the words of the plot.
const char* judge(const lcp::KnownProblem& problem, const exercises::Driven& got) {
  if (got.status == lcp::Status::limit) return "limit";
  if (got.status == lcp::Status::no_solution) {
    const bool proved = got.certificate.size() == problem.b.size() &&
                        lcp::certifies_no_solution(problem.lcp(), got.certificate);
    return proved ? "right" : "a solution lost";
  }
  const VecX w = lcp::evaluate(problem.A, problem.b, got.z);
  return lcp::acceptable(problem.lcp(), got.z, w) ? "right" : "solved wrongly";
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch03_ex04";
  using lcp::Family;
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "ends.csv", {{"family", ""}, {"end", ""}, {"problems", ""}});
    for (const Family family : {Family::random_spd, Family::degenerate, Family::rank_deficient,
                                Family::duplicate_contacts, Family::stack, Family::infeasible}) {
      std::printf("%-20s", std::string(lcp::name(family)).c_str());
      for (const std::string end : {"right", "solved wrongly", "a solution lost", "limit"}) {
        std::int64_t count = 0;
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
          const lcp::KnownProblem problem = lcp::make_problem(family, 12, seed);
          count += judge(problem, exercises::drive_all(problem.A, problem.b, 500)) == end;
        }
        table.row({std::string(lcp::name(family)), end, count});
        std::printf("  %s: %ld", end.c_str(), static_cast<long>(count));
      }
      std::printf("\n");
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch03_ex04_lost_solutions.py %s\n", folder.string().c_str());
}

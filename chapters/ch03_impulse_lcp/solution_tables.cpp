#include "ch03_impulse_lcp/solution_tables.hpp"

#include <fmt/format.h>

#include <chrono>

#include "ch03_impulse_lcp/unsolved.hpp"

namespace fc::lcp {
namespace {

// z and w, and where there is no solution, the proof: y >= 0 with A'y <= 0 and b'y < 0.
void write_answer(const LcpResult& lcp, const std::filesystem::path& file) {
  const bool proved = lcp.status == Status::no_solution;
  std::vector<Column> columns = {{"row", ""}, {"z", ""}, {"w", ""}};
  if (proved) columns.push_back({"y", ""});
  TableWriter table(file, columns);
  for (Eigen::Index i = 0; i < lcp.z.size(); ++i) {
    std::vector<Cell> cells = {std::int64_t{i}, lcp.z[i], lcp.w[i]};
    if (proved) cells.emplace_back(lcp.certificate[i]);
    table.row(cells);
  }
  table.close();
}

}  // namespace

std::int64_t now_ns() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

TimedResult solve_timed(const Lcp& problem, const Solver& solver) {
  const std::int64_t start = now_ns();
  LcpResult lcp = solver(problem);
  return {std::move(lcp), now_ns() - start};
}

void write_solution(const Lcp& problem, const TimedResult& solved, const SolverSpec& spec,
                    const RunContext& context, Summary& summary) {
  const LcpResult& lcp = solved.lcp;
  write_answer(lcp, context.out_dir / "solution.csv");
  summary.add("solver", spec.method);
  summary.add("status", name(lcp.status));
  summary.add("rows", std::int64_t{lcp.z.size()});
  summary.add(counted_by(spec.method), std::int64_t{lcp.pivots});
  summary.add("residual", lcp.residual, "1");

  TableWriter solvers(
      context.out_dir / "solvers.csv",
      {{"solver", ""}, {"status", ""}, {"pivots_or_sweeps", ""}, {"residual", ""}, {"wall_ns", ""}});
  const auto add = [&](std::string_view method, const TimedResult& result) {
    solvers.row({std::string(method), name(result.lcp.status), std::int64_t{result.lcp.pivots},
                 result.lcp.residual, result.ns});
  };
  add(spec.method, solved);
  for (const Method method : kMethods) {
    if (!spec.compare || method == method_named(spec.method)) continue;
    SolverSpec other = spec;
    other.method = name(method);
    const TimedResult result = solve_timed(problem, solver_of(other));
    add(other.method, result);
    summary.add(other.method, fmt::format("{}, residual {:.2g}, {} {}", name(result.lcp.status),
                                          result.lcp.residual, result.lcp.pivots, counted_by(other.method)));
  }
  solvers.close();
}

}  // namespace fc::lcp

#include "ch03_impulse_lcp/lcp_run.hpp"

#include <fmt/format.h>

#include <optional>

#include "ch03_impulse_lcp/matrix_market.hpp"
#include "ch03_impulse_lcp/solution_tables.hpp"
#include "ch03_impulse_lcp/unsolved.hpp"

namespace fc::lcp {
namespace {

// A vector in a Matrix Market file: one column of n numbers.
VecX read_vector(const std::filesystem::path& file, Eigen::Index n) {
  const MatX column = read_matrix_market(file);
  if (column.cols() != 1 || column.rows() != n) {
    throw InputError({file.string(), 0, 0},
                     fmt::format("{} by {} numbers, but the matrix has {} rows; one column of {} is needed",
                                 column.rows(), column.cols(), n, n));
  }
  return column;
}

struct GivenLcp {
  MatX A;
  VecX b;
  std::optional<VecX> solution;
};

GivenLcp read_lcp_of(const LcpSpec& spec) {
  GivenLcp given;
  given.A = spec.matrix ? *spec.matrix : read_matrix_market(*spec.matrix_file);
  const auto n = given.A.rows();
  if (n != given.A.cols()) {
    const SourceMark where = spec.matrix_file ? SourceMark{spec.matrix_file->string(), 0, 0} : spec.where;
    throw InputError(where,
                     fmt::format("the matrix of an LCP is square, this one is {} by {}", n, given.A.cols()));
  }
  given.b = spec.vector ? *spec.vector : read_vector(*spec.vector_file, n);
  if (spec.solution_file) given.solution = read_vector(*spec.solution_file, n);
  return given;
}

}  // namespace

void check_lcp(const LcpSpec& spec) {
  read_lcp_of(spec);
}

int run_lcp(const LcpSpec& spec, const SolverSpec& solver, const Solver& solve, const RunContext& context,
            Summary& summary) {
  const auto [A, b, known] = read_lcp_of(spec);
  const TimedResult solved = solve_timed({A, b}, solve);
  write_solution({A, b}, solved, solver, context, summary);
  if (known && b.size() > 0) {
    // Velocities, not impulses: for a singular matrix z is not unique, but w is.
    summary.add("largest difference of w from the given solution",
                (solved.lcp.w - evaluate(A, b, *known)).lpNorm<Eigen::Infinity>());
  }
  summary.counter(solver.method, 1, solved.ns);
  if (solved.lcp.status == Status::no_solution)  // after the tables are written
    throw SceneFailure(
        "there is no solution: the column y of solution.csv proves it, A'y <= 0 and b'y < 0; "
        "change A or b",
        "lcp");
  if (solved.lcp.status != Status::solved)
    throw unsolved(solver, solved.lcp.status, solved.lcp.pivots, solved.lcp.residual);
  return 0;
}

}  // namespace fc::lcp

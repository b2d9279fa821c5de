#include "ch03_impulse_lcp/solver.hpp"

#include <memory>
#include <stdexcept>
#include <string>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/interior_point.hpp"
#include "ch03_impulse_lcp/lemke.hpp"
#include "ch03_impulse_lcp/projected_gauss_seidel.hpp"
#include "common/scene.hpp"

namespace fc::lcp {

std::string_view name(Method method) {
  switch (method) {
    case Method::dantzig:
      return "dantzig";
    case Method::lemke:
      return "lemke";
    case Method::pgs:
      return "pgs";
    case Method::interior_point:
      return "interior_point";
  }
  return "dantzig";
}

Method method_named(std::string_view name) {
  for (const Method method : kMethods) {
    if (lcp::name(method) == name) return method;
  }
  throw std::invalid_argument("LCP: no method is called '" + std::string(name) + "'");
}

void require(double tolerance, LcpResult& result) {
  if (result.status == Status::solved && tolerance > 0 && result.residual > tolerance)
    result.status = Status::limit;
}

LcpResult solve(const Lcp& problem, Method method, const SolveOptions& options) {
  LcpResult result;
  switch (method) {
    case Method::pgs:
      return solve_pgs(problem, options);
    case Method::interior_point:
      return solve_interior_point(problem, options);
    case Method::lemke:
      result = solve_lemke(problem, options);
      break;
    case Method::dantzig:
      result = solve_dantzig(problem, {.max_pivots = options.limit, .start = options.start});
      break;
  }
  require(options.tolerance, result);
  return result;
}

Solver solver_of(const SolverSpec& spec) {
  const Method method = method_named(spec.method);
  const SolveOptions options{.limit = spec.limit, .tolerance = spec.tolerance};
  if (method != Method::dantzig)
    return [method, options](const Lcp& problem) { return solve(problem, method, options); };
  return [solver = std::make_shared<DantzigSolver>(), options](const Lcp& problem) {
    LcpResult result;
    solver->solve(problem, {.max_pivots = options.limit}, result);
    require(options.tolerance, result);
    return result;
  };
}

}  // namespace fc::lcp

#include "ch03_impulse_lcp/solver.hpp"

#include "ch03_impulse_lcp/dantzig.hpp"

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

LcpResult solve(const Lcp& problem, Method method, const SolveOptions& options) {
  switch (method) {
    case Method::dantzig:
    case Method::lemke:
    case Method::pgs:
    case Method::interior_point:
      break;
  }
  return solve_dantzig(problem, {.max_pivots = options.limit, .start = options.start});
}

}  // namespace fc::lcp

#include "ch03_impulse_lcp/solver.hpp"

#include <stdexcept>
#include <string>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/interior_point.hpp"
#include "ch03_impulse_lcp/lemke.hpp"
#include "ch03_impulse_lcp/projected_gauss_seidel.hpp"

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

LcpResult solve(const Lcp& problem, Method method, const SolveOptions& options) {
  switch (method) {
    case Method::dantzig:
      break;
    case Method::lemke:
      return solve_lemke(problem, options);
    case Method::pgs:
      return solve_pgs(problem, options);
    case Method::interior_point:
      return solve_interior_point(problem, options);
  }
  return solve_dantzig(problem, {.max_pivots = options.limit, .start = options.start});
}

}  // namespace fc::lcp

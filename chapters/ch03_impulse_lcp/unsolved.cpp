#include "ch03_impulse_lcp/unsolved.hpp"

#include <fmt/format.h>

#include "ch03_impulse_lcp/solver.hpp"

namespace fc::lcp {

const char* counted_by(const std::string& method) {
  switch (method_named(method)) {
    case Method::pgs:
      return "sweeps";
    case Method::interior_point:
      return "steps";
    default:
      return "pivots";
  }
}

SceneFailure unsolved(const SolverSpec& spec, Status status, int pivots, double residual) {
  const std::string method = "solver.method " + spec.method;
  const std::string other = spec.method == "dantzig" ? "lemke" : "dantzig";
  switch (status) {
    case Status::no_solution:
      return {method +
                  " proved that there is no solution: no velocities fulfil all these contacts at once, as "
                  "where a kinematic body presses another against a wall; change its motion",
              "solver.method"};
    case Status::unsuited:
      return {method + " is unsuited: the matrix is outside its class; use " +
                  (spec.method == "lemke" ? "dantzig" : "lemke"),
              "solver.method"};
    case Status::ray:
      return {method + " ended on a ray, which proves nothing; use " + other, "solver.method"};
    default:
      break;
  }
  if (spec.limit > 0 && pivots >= spec.limit)
    return {
        fmt::format("{} stopped after solver.limit = {} {} with a residual of {:.2g}; raise it, or use {}",
                    method, spec.limit, counted_by(spec.method), residual, other),
        "solver.limit"};
  const bool pivots_only = spec.method == "dantzig" || spec.method == "lemke";
  if (pivots_only && spec.tolerance > 0 && residual > spec.tolerance)
    return {fmt::format("{} ended with a residual of {:.2g}, and solver.tolerance asks for {:g}; raise it",
                        method, residual, spec.tolerance),
            "solver.tolerance"};
  if (spec.tolerance > 0 && residual <= spec.tolerance)
    return {
        fmt::format("{} ended at solver.tolerance = {:g} with a residual of {:.2g}, too large for an impact; "
                    "lower it, or use {}",
                    method, spec.tolerance, residual, other),
        "solver.tolerance"};
  return {fmt::format("{} stopped after {} {} with a residual of {:.2g}: its own limit, or round-off; raise "
                      "solver.limit, or use {}",
                      method, pivots, counted_by(spec.method), residual, other),
          "solver.method"};
}

}  // namespace fc::lcp

// All solvers of the chapter behind one function: problem in, checked result out.
#pragma once

#include <array>
#include <functional>
#include <ostream>
#include <string_view>

#include "ch03_impulse_lcp/problem.hpp"

namespace fc {
struct SolverSpec;  // common/scene.hpp
}

namespace fc::lcp {

enum class Method {
  dantzig,         // dantzig.hpp: exact, symmetric positive semidefinite and P-matrices, the default
  lemke,           // lemke.hpp: exact, the widest class of matrices
  pgs,             // projected_gauss_seidel.hpp: iterative, what most engines use
  interior_point,  // interior_point.hpp: Newton's method on a smoothed problem, positive semidefinite
                   // matrices
};

inline constexpr std::array<Method, 4> kMethods = {Method::dantzig, Method::lemke, Method::pgs,
                                                   Method::interior_point};

// The words of `solver.method` and of solvers.csv: "dantzig", "lemke", "pgs", "interior_point".
std::string_view name(Method method);
inline std::ostream& operator<<(std::ostream& out, Method method) {
  return out << name(method);
}
// The method of that name. Throws std::invalid_argument for another word.
Method method_named(std::string_view name);

// The default residual at which iterative methods stop.
inline constexpr double kUsualResidual = 1e-10;

struct SolveOptions {
  int limit = 0;         // pivots, sweeps or steps; 0: the method's own, stated in its header
  double tolerance = 0;  // the residual at which an iterative method stops, and that others must have; 0: the
                         // method's own
  // n, a guess of z (for example the last step's); methods that cannot use it ignore it.
  const VecX* start = nullptr;
};

// A residual beyond the tolerance (if > 0) turns `solved` into `limit`.
void require(double tolerance, LcpResult& result);

// Solves the problem by the method. Guarantee: `solved` only if the result passed acceptable(); a method that
// cannot solve such a problem (bounds, a matrix outside its class) returns `unsuited`. Throws
// std::invalid_argument for sizes that do not match, entries that are not finite, and bounds that violate
// Lcp's conditions.
LcpResult solve(const Lcp& problem, Method method = Method::dantzig, const SolveOptions& options = {});

// Rows -> impulses: what the impact law calls.
using Solver = std::function<LcpResult(const Lcp&)>;

// The solver that a scene asks for: its method, limit and tolerance. Dantzig's keeps its memory from one call to the next.
Solver solver_of(const SolverSpec& spec);

}  // namespace fc::lcp

// All solvers of the chapter behind one function, as in chapter 3: problem in, result out, and every result is checked.
#pragma once

#include <array>
#include <ostream>
#include <string_view>

#include "ch06_friction/cone_problem.hpp"

namespace fc::friction {

enum class Method {
  combined,      // the default: the others in turn, see solve()
  gauss_seidel,  // gauss_seidel.hpp: contact by contact, exactly
  newton,        // newton.hpp: quadratic convergence near an answer
  pyramid,       // pyramid.hpp: Lemke's method on a cone with flat sides, turned into the slip
  boxed,         // boxed.hpp: Dantzig's method with bounds on each tangent; its errors are a lesson
};

inline constexpr std::array<Method, 5> kMethods = {Method::combined, Method::gauss_seidel, Method::newton,
                                                   Method::pyramid, Method::boxed};

// "combined", "gauss_seidel", "newton", "pyramid", "boxed".
std::string_view name(Method method);
inline std::ostream& operator<<(std::ostream& out, Method method) {
  return out << name(method);
}
// The method of that name. Throws std::invalid_argument for any other name.
Method method_named(std::string_view name);

struct SolveOptions {
  int limit = 0;                // sweeps, steps or rounds; 0: the method's own, stated in its header
  double tolerance = 1e-10;     // the residual at which a method stops, and which its answer must have
  const VecX* start = nullptr;  // 3n, a guess of r (the last step's, say), projected onto the cones; null: 0
  int sides = 8;                // of a pyramid, even, >= 4
  bool turned = true;           // whether a pyramid's sides follow the slip
  int draw = 0;  // where its sides begin: 0: at tangent 1; others, >= 0: at angles drawn by this number
};

// Solves the problem by the method. Guarantee: `solved` only if the result passed acceptable() and has the residual
// asked for (or one at the level of round-off). A matrix that is not symmetric, or has a negative diagonal entry, is
// `unsuited`; a contact whose rows are zero while its b approaches has `no_solution`. Throws std::invalid_argument for
// arguments that check_arguments() refuses, and for a start of another size.
//
// `combined` tries, in this order, until one solves it:
//   where no contact has friction, chapter 3's method of Dantzig on the normals alone;
//   Gauss-Seidel's sweeps and, from their state after 20, 50, 100, 200 and 400, Newton's steps (where sweeps go in
//     circles, each state is another start; Newton's only up to 300 contacts);
//   answers for pyramids of 8 sides whose angles are drawn anew, up to 200 times, and Newton's steps from there (up to
//     60 contacts; the more contacts, the fewer draws);
//   Gauss-Seidel with its relaxation, to options.limit, and Newton's steps from there.
// The work of all is counted. If none solves it, the answer with the smallest residual is returned.
ConeResult solve(const ConeProblem& problem, Method method = Method::combined,
                 const SolveOptions& options = {});

}  // namespace fc::friction

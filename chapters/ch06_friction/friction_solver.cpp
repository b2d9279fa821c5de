#include "ch06_friction/friction_solver.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "ch06_friction/boxed.hpp"
#include "ch06_friction/gauss_seidel.hpp"
#include "ch06_friction/newton.hpp"
#include "ch06_friction/pyramid.hpp"
#include "ch06_friction/start.hpp"

namespace fc::friction {
namespace {

// Sweeps before each attempt of Newton's method. Many problems need only the first attempt; sweeps that go in circles
// end in another place each time.
constexpr std::array<int, 5> kSweepsBeforeNewton = {20, 30, 50, 100, 200};
// Pyramids to start from where sweeps do not help, with sides drawn at random each time. For µ = 3, one problem in 70
// needs them; for the hardest known, one draw in 70 leads to an answer. For a large problem a draw takes long.
constexpr int kDraws = 200;
constexpr int kDrawnContacts = 4000;
// With more contacts a Newton step, or a pyramid, takes longer than very many sweeps: seconds.
constexpr Eigen::Index kNewtonContacts = 300;
constexpr Eigen::Index kPyramidContacts = 60;

// Tries method after method on one problem; counts their work, and keeps the answer with the smallest residual.
class Sequence {
 public:
  Sequence(const ConeProblem& problem, const SolveOptions& options) : problem_(problem), options_(options) {}

  // Whether this method solved it.
  bool tries(Method method, const VecX& start, SolveOptions options) {
    options.start = &start;
    options.tolerance = options_.tolerance;
    last_ = solve(problem_, method, options);
    const ConeResult work = best_;
    if (!started_ || last_.residual < best_.residual || last_.status == Status::solved) best_ = last_;
    best_.sweeps = work.sweeps + last_.sweeps;
    best_.steps = work.steps + last_.steps;
    best_.pivots = work.pivots + last_.pivots;
    best_.relaxation = std::min(work.relaxation, last_.relaxation);
    started_ = true;
    return best_.status == Status::solved;
  }
  const VecX& last() const { return last_.r; }
  const ConeResult& best() const { return best_; }

 private:
  const ConeProblem& problem_;
  const SolveOptions& options_;
  ConeResult last_, best_;
  bool started_ = false;
};

ConeResult solve_combined(const ConeProblem& problem, const SolveOptions& options) {
  ConeResult result;
  if (refused(problem, options, result)) return result;
  if (problem.mu.isZero(0)) return solve_frictionless(problem, options);

  const bool newton = problem.contacts() <= kNewtonContacts;
  Sequence methods(problem, options);
  VecX r = start_in_cones(problem, options.start);
  for (const int sweeps : kSweepsBeforeNewton) {
    if (methods.tries(Method::gauss_seidel, r, {.limit = sweeps})) return methods.best();
    r = methods.last();
    if (newton && methods.tries(Method::newton, r, {})) return methods.best();
  }
  if (problem.contacts() <= kPyramidContacts) {
    for (int draw = 0; draw < std::min(kDraws, kDrawnContacts / static_cast<int>(problem.contacts()));
         ++draw) {
      if (methods.tries(Method::pyramid, r, {.turned = false, .draw = draw})) return methods.best();
      const VecX of_pyramid = methods.last();
      if (methods.tries(Method::newton, of_pyramid, {})) return methods.best();
    }
  }
  if (methods.tries(Method::gauss_seidel, r, {.limit = options.limit})) return methods.best();
  r = methods.last();
  if (newton) methods.tries(Method::newton, r, {});
  return methods.best();
}

}  // namespace

std::string_view name(Method method) {
  switch (method) {
    case Method::combined:
      return "combined";
    case Method::gauss_seidel:
      return "gauss_seidel";
    case Method::newton:
      return "newton";
    case Method::pyramid:
      return "pyramid";
    case Method::boxed:
      return "boxed";
  }
  return "combined";
}

Method method_named(std::string_view name) {
  for (const Method method : kMethods) {
    if (friction::name(method) == name) return method;
  }
  throw std::invalid_argument("friction: no method is called '" + std::string(name) + "'");
}

ConeResult solve(const ConeProblem& problem, Method method, const SolveOptions& options) {
  switch (method) {
    case Method::gauss_seidel:
      return solve_gauss_seidel(problem, options);
    case Method::newton:
      return solve_newton(problem, options);
    case Method::pyramid:
      return solve_pyramid(problem, options);
    case Method::boxed:
      return solve_boxed(problem, options);
    case Method::combined:
      break;
  }
  return solve_combined(problem, options);
}

}  // namespace fc::friction

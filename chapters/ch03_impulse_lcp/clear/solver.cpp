#include "ch03_impulse_lcp/clear/solver.hpp"

#include "ch03_impulse_lcp/active_set.hpp"
#include "common/scene.hpp"

namespace fc::lcp::clear {
namespace {

LcpResult checked(const Lcp& problem, const SolverSpec& spec, DantzigFunction* dantzig) {
  check_arguments(problem);
  if (problem.boxed() || problem.A != problem.A.transpose()) return refused(problem, Status::unsuited);
  const LcpResult given = dantzig(problem.A, problem.b, spec.limit);
  const bool whole = given.z.size() == problem.size();
  LcpResult result = whole ? judged(problem, given.z, given.status) : refused(problem, Status::limit);
  result.pivots = given.pivots;
  if (result.status == Status::no_solution) {
    if (given.certificate.size() == problem.size())
      result.certificate = no_solution_certificate(problem, given.certificate);
    if (result.certificate.size() == 0) result.status = Status::limit;
  }
  require(spec.tolerance, result);
  return result;
}

}  // namespace

std::vector<PieceSlot> slots(Pieces& pieces) {
  return {slot("ch03/ex06_dantzig", "impulses by Dantzig's method", pieces.dantzig)};
}

Solver solver_of(const SolverSpec& spec, const Pieces& pieces) {
  if (method_named(spec.method) != Method::dantzig) return lcp::solver_of(spec);
  return [spec, dantzig = pieces.dantzig](const Lcp& problem) { return checked(problem, spec, dantzig); };
}

}  // namespace fc::lcp::clear

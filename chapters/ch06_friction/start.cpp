#include "ch06_friction/start.hpp"

#include <stdexcept>
#include <string>

#include "ch06_friction/cone.hpp"

namespace fc::friction {

bool refused(const ConeProblem& problem, const SolveOptions& options, ConeResult& result) {
  check_arguments(problem);
  if (options.start != nullptr && options.start->size() != problem.b.size()) {
    throw std::invalid_argument("friction: the start has " + std::to_string(options.start->size()) +
                                " entries, the problem " + std::to_string(problem.b.size()));
  }
  if (options.sides < 4 || options.sides % 2 != 0)
    throw std::invalid_argument("friction: a pyramid of " + std::to_string(options.sides) +
                                " sides; an even number from 4 on is needed");
  bool hopeless = false;
  for (Eigen::Index i = 0; i < problem.contacts(); ++i) {
    hopeless = hopeless || (problem.b[3 * i] < 0 && problem.A.row(3 * i).isZero(0));
  }
  const bool suited = is_suited(problem);
  if (suited && !hopeless) return false;
  judge(problem, VecX::Zero(problem.b.size()), 0, suited ? Status::no_solution : Status::unsuited, result);
  if (!suited) result.status = Status::unsuited;
  return true;
}

VecX start_in_cones(const ConeProblem& problem, const VecX* start) {
  VecX r = VecX::Zero(problem.b.size());
  if (start == nullptr) return r;
  for (Eigen::Index i = 0; i < problem.contacts(); ++i) {
    r.segment<3>(3 * i) = project_onto_cone(start->segment<3>(3 * i), problem.mu[i]);
  }
  return r;
}

}  // namespace fc::friction

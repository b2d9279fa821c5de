#include "ex07_resting_step.hpp"

namespace fc::mine {

RestingResult resting_step(const RestingProblem& island, const LcpFunction& solve_lcp) {
  return resting::clear::resting_step(island, solve_lcp);
}

}  // namespace fc::mine

#include "ex07_resting_step.hpp"

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "common/todo.hpp"

namespace fc::mine {

RestingResult resting_step(const RestingProblem& island, const LcpFunction& solve_lcp) {
  FC_TODO("5.7");
}

}  // namespace fc::mine

#include "ex05_scrape.hpp"

#include "ch03_impulse_lcp/solver.hpp"
#include "common/todo.hpp"

namespace fc::exercises {

Scrape scrape(RigidBody& body, const Touch& touch) {
  FC_TODO("3.5");
}

}  // namespace fc::exercises

// Caught by: Ex03OwnTime.LooksAtFewPairs
// As FAST and C2A: from the root down at each time, for the shortest safe step of all pairs of leaves.
#include <algorithm>

#include "ex03_own_time.hpp"

namespace fc::exercises {
namespace {

struct Step {
  const Pairs& pairs;
  int most, looks = 0;
  double t = 0, until = 0;
  int reached = -1;

  void visit(int pair) {
    if (looks++ >= most) return;
    const Look look = pairs.look(pair, t);
    if (look.reached) reached = pair;
    if (look.clear_until >= until) return;
    if (look.children.empty()) until = look.clear_until;
    for (const int child : look.children) visit(child);
  }
};

}  // namespace

Found first_contact(const Pairs& pairs, double interval, int most) {
  Step step{pairs, most};
  while (step.t < interval) {
    step.until = interval;
    step.visit(pairs.root);
    if (step.looks > most) return {ca::Status::unresolved, step.t, -1};
    if (step.reached >= 0) return {ca::Status::contact, step.t, step.reached};
    step.t = step.until;
  }
  return {ca::Status::separated, interval, -1};
}

}  // namespace fc::exercises

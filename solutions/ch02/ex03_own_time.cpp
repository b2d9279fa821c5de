#include "ex03_own_time.hpp"

#include <queue>

namespace fc::exercises {

// All pairs wait in one queue, the earliest on top. Everything else has a later time, so a pair of leaves
// that has reached its target when it is on top is the first contact, and what was never on top need not be
// known.
Found first_contact(const Pairs& pairs, double interval, int most) {
  struct Waiting {
    double time;
    int pair;
    // A queue has the largest on top: that is to be the earliest.
    bool operator<(const Waiting& other) const { return time > other.time; }
  };
  std::priority_queue<Waiting> queue;
  const auto wait = [&](double time, int pair) {
    if (time < interval) queue.push({time, pair});
  };
  wait(0, pairs.root);
  for (int looks = 0; !queue.empty(); ++looks) {
    const Waiting top = queue.top();
    if (looks == most) return {ca::Status::unresolved, top.time, -1};
    queue.pop();
    const Look look = pairs.look(top.pair, top.time);
    if (look.reached) return {ca::Status::contact, top.time, top.pair};
    if (look.children.empty()) wait(look.clear_until, top.pair);
    for (const int child : look.children) wait(look.clear_until, child);
  }
  return {ca::Status::separated, interval, -1};
}

}  // namespace fc::exercises

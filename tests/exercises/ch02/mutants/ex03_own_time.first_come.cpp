// Caught by: Ex03OwnTime.LooksAtNothingBeyondTheContact
// In the order of coming, to the end; the earliest of all contacts is the answer. Right, and far too many
// looks.
#include "ex03_own_time.hpp"

#include <queue>

namespace fc::exercises {

Found first_contact(const Pairs& pairs, double interval, int most) {
  struct Waiting {
    double time;
    int pair;
  };
  std::queue<Waiting> queue;
  Found best{ca::Status::separated, interval, -1};
  queue.push({0, pairs.root});
  for (int looks = 0; !queue.empty(); ++looks) {
    const Waiting top = queue.front();
    if (looks == most) return {ca::Status::unresolved, top.time, -1};
    queue.pop();
    const Look look = pairs.look(top.pair, top.time);
    if (look.reached) {
      if (top.time < best.time) best = {ca::Status::contact, top.time, top.pair};
      continue;
    }
    if (look.clear_until >= interval) continue;
    if (look.children.empty()) queue.push({look.clear_until, top.pair});
    for (const int child : look.children) queue.push({look.clear_until, child});
  }
  return best;
}

}  // namespace fc::exercises

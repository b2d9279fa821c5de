// Caught by: Ex03OwnTime.AnIntervalOfNothingNeedsNoLook
// The root is looked at before anybody asks for its time.
#include <queue>

#include "ex03_own_time.hpp"

namespace fc::exercises {

Found first_contact(const Pairs& pairs, double interval, int most) {
  struct Waiting {
    double time;
    int pair;
    bool operator<(const Waiting& other) const { return time > other.time; }
  };
  std::priority_queue<Waiting> queue;
  queue.push({0, pairs.root});
  for (int looks = 0; !queue.empty(); ++looks) {
    const Waiting top = queue.top();
    if (looks == most) return {ca::Status::unresolved, top.time, -1};
    queue.pop();
    const Look look = pairs.look(top.pair, top.time);
    if (look.reached) return {ca::Status::contact, top.time, top.pair};
    if (look.clear_until >= interval) continue;
    if (look.children.empty()) queue.push({look.clear_until, top.pair});
    for (const int child : look.children) queue.push({look.clear_until, child});
  }
  return {ca::Status::separated, interval, -1};
}

}  // namespace fc::exercises

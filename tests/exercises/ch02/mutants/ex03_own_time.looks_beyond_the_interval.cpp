// Caught by: Ex03OwnTime.WhatIsBeyondTheIntervalIsGone
// Whether a pair is beyond the interval is asked when it is on top, after it was looked at.
#include "ex03_own_time.hpp"

#include <queue>

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
    if (top.time >= interval) break;
    if (look.children.empty()) queue.push({look.clear_until, top.pair});
    for (const int child : look.children) queue.push({look.clear_until, child});
  }
  return {ca::Status::separated, interval, -1};
}

}  // namespace fc::exercises

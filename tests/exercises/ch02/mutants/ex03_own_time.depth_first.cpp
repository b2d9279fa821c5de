// Caught by: Ex03OwnTime.FindsTheFirstContact
// The pair that came last is taken first, and the first that reached its target is the answer.
#include "ex03_own_time.hpp"

#include <vector>

namespace fc::exercises {

Found first_contact(const Pairs& pairs, double interval, int most) {
  struct Waiting {
    double time;
    int pair;
  };
  std::vector<Waiting> queue;
  queue.push_back({0, pairs.root});
  for (int looks = 0; !queue.empty(); ++looks) {
    const Waiting top = queue.back();
    if (looks == most) return {ca::Status::unresolved, top.time, -1};
    queue.pop_back();
    const Look look = pairs.look(top.pair, top.time);
    if (look.reached) return {ca::Status::contact, top.time, top.pair};
    if (look.clear_until >= interval) continue;
    if (look.children.empty()) queue.push_back({look.clear_until, top.pair});
    for (const int child : look.children) queue.push_back({look.clear_until, child});
  }
  return {ca::Status::separated, interval, -1};
}

}  // namespace fc::exercises

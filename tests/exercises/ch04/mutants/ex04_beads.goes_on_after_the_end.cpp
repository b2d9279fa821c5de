// Caught by: Ex04Beads.EqualBeadsExchangeTheirLines
// Collisions after the end take place, too, and the beads are carried back from them.
#include "ex04_beads.hpp"

#include <algorithm>
#include <functional>
#include <queue>

namespace fc::exercises {
namespace {

// The collision of bead `left` and the next one. It is void if either has had a collision since.
struct Event {
  double time;
  int left;
  std::int64_t left_count, right_count;
  bool operator>(const Event& other) const {
    return time != other.time ? time > other.time : left > other.left;
  }
};

}  // namespace

BeadsResult fly(std::vector<Bead>& beads, double duration) {
  const int n = static_cast<int>(beads.size());
  std::vector<double> times(beads.size(), 0);  // s, at which each bead's place stands
  std::vector<std::int64_t> counts(beads.size(), 0);
  std::priority_queue<Event, std::vector<Event>, std::greater<>> queue;
  BeadsResult result;

  const auto place_at = [&](int i, double time) {
    return beads[i].place + (time - times[i]) * beads[i].velocity;
  };
  const auto ask = [&](int left, double now) {
    if (left < 0 || left + 1 >= n) return;
    const double closing = beads[left].velocity - beads[left + 1].velocity;
    if (!(closing > 0)) return;
    const double gap = std::max(0.0, place_at(left + 1, now) - place_at(left, now));
    const double time = now + gap / closing;
    queue.push({time, left, counts[left], counts[left + 1]});
    ++result.events;
  };

  for (int left = 0; left + 1 < n; ++left) ask(left, 0);
  while (!queue.empty()) {
    const Event event = queue.top();
    queue.pop();
    const int i = event.left, k = event.left + 1;
    if (counts[i] != event.left_count || counts[k] != event.right_count) continue;
    // Only these two are touched: the others keep their own times.
    for (const int bead : {i, k}) {
      beads[bead].place = place_at(bead, event.time);
      times[bead] = event.time;
      ++counts[bead];
    }
    const double sum = beads[i].mass + beads[k].mass, closing = beads[i].velocity - beads[k].velocity;
    beads[i].velocity -= 2 * beads[k].mass / sum * closing;
    beads[k].velocity += 2 * beads[i].mass / sum * closing;
    ++result.collisions;
    for (const int left : {i - 1, i, k}) ask(left, event.time);
  }
  for (int i = 0; i < n; ++i) beads[i].place = place_at(i, duration);
  return result;
}

}  // namespace fc::exercises

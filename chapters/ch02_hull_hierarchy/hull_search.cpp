#include "ch02_hull_hierarchy/hull_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "ch02_hull_hierarchy/steps.hpp"

namespace fc::hulls {
namespace {

// Two nodes whose room is small against their size are opened rather than advanced: their children know
// better.
constexpr double kOpenBelow = 0.2;  // of the sum of their radii

struct WaitingHulls {
  double time;
  double apart;  // m, about how far apart the pair can be at most: the last certified gap and both radii
  int a, b;
  // The queue's top: earliest; of those that stand at the same time the one with the least `apart`, which
  // leads straight down to leaves instead of opening every pair of that time; then the order of the trees.
  bool operator<(const WaitingHulls& other) const {
    if (time != other.time) return time > other.time;
    if (apart != other.apart) return apart > other.apart;
    return a != other.a ? a > other.a : b > other.b;
  }
};

struct Search {
  const HullModel& a;
  const ca::Motion& motion_a;
  const HullModel& b;
  const ca::Motion& motion_b;
  const ReachOptions& options;
  std::priority_queue<WaitingHulls> queue{};
  Reach reach{};

  void wait(double time, double gap, int node_a, int node_b) {
    if (time >= options.interval) return;
    queue.push({time, std::max(0.0, gap) + a.tree.nodes[node_a].radius + b.tree.nodes[node_b].radius, node_a,
                node_b});
  }
  void wait_for_children(double time, double gap, int node_a, int node_b) {
    const HullNode& na = a.tree.nodes[node_a];
    const HullNode& nb = b.tree.nodes[node_b];
    if (nb.leaf() || (!na.leaf() && na.radius >= nb.radius)) {
      wait(time, gap, na.left, node_b);
      wait(time, gap, na.right, node_b);
    } else {
      wait(time, gap, node_a, nb.left);
      wait(time, gap, node_a, nb.right);
    }
  }

  // Looks at one pair at the time until which it is known to be clear. True: it has reached the target.
  bool look(const WaitingHulls& pair) {
    const HullNode& na = a.tree.nodes[pair.a];
    const HullNode& nb = b.tree.nodes[pair.b];
    const bool leaves = na.leaf() && nb.leaf();
    const ca::PairPose pose(motion_a, motion_b, pair.time);
    const ca::Convex hull_a = a.convex(na), hull_b = b.convex(nb);
    ca::GjkResult g = ca::distance(hull_a, hull_b, pose, {options.slack / 4, 0.05, 128});
    ++reach.node_pairs;
    if (leaves && g.lower <= options.target) g = leaf_distance(hull_a, hull_b, pose, options.tolerance);
    // ANCHOR: look
    const double room = g.lower - options.target;
    // Pieces that overlap by rounding have no upper bound to speak of: then the lower one tells.
    const bool at_target =
        g.upper <= options.target + options.slack || g.lower <= options.target + 0.5 * options.slack;
    if (leaves && at_target && pair.time > 0) {
      reach.pair = {pair.a, pair.b, g};
      reach.time = pair.time;
      return true;
    }
    SafeStep step;
    if (room > 0) {
      step = ball_step(motion_a, hull_a, na.radius, motion_b, hull_b, nb.radius, pose, g.normal, pair.time,
                       options.interval, room);
      if (leaves) {
        const SafeStep exact = points_step(motion_a, hull_a, motion_b, hull_b, pose, g.normal, pair.time,
                                           options.interval, room);
        if (exact.time > step.time) step = exact;
      }
      step.time *= 1 - 1e-12;  // rounding of the step itself
      ++reach.advances;
    }
    const double next = pair.time + step.time;
    // No room, or a step below the rounding of the times that the caller adds this to: as far as it goes.
    if (leaves && !(step.time > std::numeric_limits<double>::epsilon() * options.interval)) {
      reach.pair = {pair.a, pair.b, g};
      reach.time = pair.time;
      return true;
    }
    if (!leaves && room <= kOpenBelow * (na.radius + nb.radius))
      wait_for_children(next, g.lower, pair.a, pair.b);
    else
      wait(next, g.lower, pair.a, pair.b);
    return false;
    // ANCHOR_END: look
  }
};

}  // namespace

Reach reach_by_hulls(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                     const ca::Motion& motion_b, const ReachOptions& options) {
  // ANCHOR: search
  Search search{a, motion_a, b, motion_b, options};
  search.wait(0, 0, 0, 0);
  Reach& reach = search.reach;
  while (!search.queue.empty()) {
    const WaitingHulls top = search.queue.top();
    if (reach.node_pairs >= options.max_pairs) {
      reach.status = Reach::Status::limit;
      reach.time = top.time;
      return std::move(reach);
    }
    search.queue.pop();
    if (search.look(top)) {
      reach.status = Reach::Status::reached;
      return std::move(reach);
    }
  }
  // ANCHOR_END: search
  reach.status = Reach::Status::clear;
  reach.time = options.interval;
  return std::move(reach);
}

}  // namespace fc::hulls

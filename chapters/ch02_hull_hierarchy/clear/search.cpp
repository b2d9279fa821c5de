#include <limits>
#include <queue>

#include "ch02_hull_hierarchy/hull_model.hpp"

namespace fc::hulls::clear {
namespace {

// ANCHOR: waiting
constexpr double kOpenBelow = 0.2;  // of both radii: with less room a pair is opened
constexpr double kShorter = 1e-12;  // share of a step that covers its own rounding
constexpr double kRoughly = 0.05;   // of both radii: how precisely a gap of inner nodes is wanted

// Two nodes, and until when they are proved to keep the target gap.
struct WaitingPair {
  double time;  // s
  int a, b;
  // A std::priority_queue has the largest on top: here, the earliest.
  bool operator<(const WaitingPair& other) const { return time > other.time; }
};

// A body as chapter 1's speed bound takes it, as if it were no larger than one of its nodes.
ca::clear::Mover mover_of(const HullModel& body, const HullNode& node, const ca::Motion& motion, double t) {
  return {motion.velocity_at(t), motion.acceleration_at(t), motion.spin_at(t), body.convex(node).reach};
}
// ANCHOR_END: waiting

}  // namespace

// ANCHOR: search
FirstContact search(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                    const ca::Motion& motion_b, const SearchOptions& options,
                    const ca::clear::Pieces& pieces) {
  FirstContact found;
  std::priority_queue<WaitingPair> queue;
  queue.push({0, 0, 0});  // the two roots
  while (!queue.empty() && queue.top().time < options.interval) {
    // The pair with the earliest time. No other pair can be in contact before.
    const auto [t, id_a, id_b] = queue.top();
    found.time = t;
    if (found.looks == options.most_looks) {
      found.status = FirstContact::Status::limit;
      return found;
    }
    queue.pop();
    ++found.looks;
    const HullNode &node_a = a.tree.nodes[id_a], &node_b = b.tree.nodes[id_b];
    const bool leaves = node_a.leaf() && node_b.leaf();
    const double radii = node_a.radius + node_b.radius;

    // Chapter 1: the gap of the two hulls now, a bound of how fast it closes, and so a step that is safe.
    const ca::PairPose pose(motion_a, motion_b, t);
    const double accuracy = leaves ? options.slack / 4 : kRoughly * radii;
    const ca::clear::Gap gap =
        pieces.gap(a.convex(node_a), b.convex(node_b), pose, accuracy, pieces.closest_point);
    const double room = gap.lower - options.target;
    double speed = 0, next = t;
    if (room > 0) {
      speed = pieces.speed_bound(gap.normal, mover_of(a, node_a, motion_a, t),
                                 mover_of(b, node_b, motion_b, t), options.interval - t);
      next = speed > 0 ? t + (1 - kShorter) * room / speed : std::numeric_limits<double>::infinity();
      ++found.advances;
    }

    // Two leaves at the target are the first contact; so are two that cannot advance any further.
    const double enough = t == 0 ? options.start : options.target + options.slack;
    const bool contact = leaves && (gap.lower <= enough || !(next > t));
    const bool open = !leaves && room <= kOpenBelow * radii;
    if (options.looks != nullptr)
      options.looks->push_back({t, id_a, id_b, gap.lower, speed, next,
                                contact ? Look::Fate::contact
                                : open  ? Look::Fate::opened
                                        : Look::Fate::advanced});
    if (contact) {
      found.status = FirstContact::Status::contact;
      found.piece_a = node_a.piece;
      found.piece_b = node_b.piece;
      return found;
    }

    // The pair goes on waiting, or the two children of its larger node wait in its place: what is proved of it holds
    // for them.
    if (!open) {
      queue.push({next, id_a, id_b});
    } else if (node_b.leaf() || (!node_a.leaf() && node_a.radius >= node_b.radius)) {
      queue.push({next, node_a.left, id_b});
      queue.push({next, node_a.right, id_b});
    } else {
      queue.push({next, id_a, node_b.left});
      queue.push({next, id_a, node_b.right});
    }
  }
  found.status = FirstContact::Status::clear;
  found.time = options.interval;
  return found;
}
// ANCHOR_END: search

}  // namespace fc::hulls::clear

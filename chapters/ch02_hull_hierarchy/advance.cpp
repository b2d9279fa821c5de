#include "ch02_hull_hierarchy/advance.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <stdexcept>

#include "ch02_hull_hierarchy/features.hpp"
#include "ch02_hull_hierarchy/inside.hpp"
#include "ch02_hull_hierarchy/steps.hpp"

namespace fc::hulls {
namespace {

// Two nodes whose room is small against their size are opened rather than advanced: their children know
// better.
constexpr double kOpenBelow = 0.2;  // of the sum of their radii

struct Waiting {
  double time;
  double apart;  // m, about how far apart the pair can be at most: the last certified gap and both radii
  int a, b;
  // The queue's top: earliest; of those that stand at the same time the one with the least `apart`, which
  // leads straight down to leaves instead of opening every pair of that time; then the order of the trees.
  bool operator<(const Waiting& other) const {
    if (time != other.time) return time > other.time;
    if (apart != other.apart) return apart > other.apart;
    return a != other.a ? a > other.a : b > other.b;
  }
};

struct Search {
  const Model& a;
  const ca::Motion& motion_a;
  const Model& b;
  const ca::Motion& motion_b;
  const ReachOptions& options;
  bool certificate;
  std::priority_queue<Waiting> queue{};
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
  bool look(const Waiting& pair) {
    const HullNode& na = a.tree.nodes[pair.a];
    const HullNode& nb = b.tree.nodes[pair.b];
    const bool leaves = na.leaf() && nb.leaf();
    const ca::PairPose pose(motion_a, motion_b, pair.time);
    const ca::Convex hull_a = a.convex(na), hull_b = b.convex(nb);
    ca::GjkResult g = ca::distance(hull_a, hull_b, pose, {options.slack / 4, 0.05, 128});
    ++reach.node_pairs;
    if (leaves && g.lower <= options.target) g = leaf_distance(hull_a, hull_b, pose, options.tolerance);
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
        const SafeStep exact =
            plane_step(motion_a, hull_a, motion_b, hull_b, pose, g.normal, pair.time, room);
        if (exact.time > step.time) step = exact;
      }
      step.time *= 1 - 1e-12;  // rounding of the step itself
      ++reach.advances;
      if (certificate)
        reach.certificate.push_back(
            {pair.time, g.normal, g.lower, step.speed, std::min(step.time, options.interval - pair.time)});
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
  }
};

}  // namespace

Reach first_reach(const Model& a, const ca::Motion& motion_a, const Model& b, const ca::Motion& motion_b,
                  const ReachOptions& options, bool certificate) {
  // ANCHOR: search
  Search search{a, motion_a, b, motion_b, options, certificate};
  search.wait(0, 0, 0, 0);
  Reach& reach = search.reach;
  while (!search.queue.empty()) {
    const Waiting top = search.queue.top();
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

ca::AdvanceResult advance(const Model& a, const ca::Motion& motion_a, const Model& b,
                          const ca::Motion& motion_b, const ca::AdvanceOptions& options) {
  ca::check_query(motion_a, motion_b, options);
  if (motion_a.free || motion_b.free)
    throw std::invalid_argument("advance: this chapter's steps need bodies whose spin is constant");
  ca::AdvanceResult result;
  const ca::PairPose start(motion_a, motion_b, 0), end(motion_a, motion_b, options.interval);
  const ca::Convex root_a = a.convex(a.tree.nodes[0]), root_b = b.convex(b.tree.nodes[0]);
  result.tolerance = std::max(options.tolerance, 8 * std::max(ca::rounding_term(root_a, root_b, start),
                                                              ca::rounding_term(root_a, root_b, end)));
  const double tolerance = result.tolerance;
  const auto finish = [&](ca::Status status, double toc) {
    result.status = status;
    result.toc = toc;
    const ca::PairPose pose(motion_a, motion_b, toc);
    const ModelDistance d = model_distance(a, b, pose, tolerance);
    result.distance_calls += d.distance_calls;
    result.gap_lower = d.lower;
    result.gap_upper = d.upper;
    if (status == ca::Status::contact || status == ca::Status::touching_at_start)
      result.features = contact_features(a, b, pose, motion_a.position_at(toc), tolerance);
  };

  const ModelDistance d = model_distance(a, b, start, tolerance, tolerance);
  result.distance_calls = d.distance_calls;
  if (d.lower < -tolerance || one_inside_other(a, b, start)) {
    finish(ca::Status::penetrating_at_start, 0);
    result.gap_upper = 0;
    result.gap_lower = std::min(result.gap_lower, 0.0);
    return result;
  }
  if (d.upper <= tolerance) {
    finish(ca::Status::touching_at_start, 0);
    return result;
  }
  ReachOptions reach_options;
  reach_options.interval = options.interval;
  reach_options.target = 0.5 * tolerance;
  reach_options.slack = 0.25 * tolerance;
  reach_options.tolerance = tolerance;
  reach_options.max_pairs = options.max_iterations;
  const Reach reach = first_reach(a, motion_a, b, motion_b, reach_options, options.certificate);
  result.iterations = reach.advances;
  result.node_pairs = reach.node_pairs;
  result.distance_calls += reach.node_pairs;
  result.certificate = reach.certificate;
  const ca::Status status = reach.status == Reach::Status::clear   ? ca::Status::separated
                            : reach.status == Reach::Status::limit ? ca::Status::unresolved
                                                                   : ca::Status::contact;
  finish(status, reach.time);
  if (status == ca::Status::contact && !(result.gap_upper <= tolerance))
    result.status = ca::Status::unresolved;
  return result;
}

}  // namespace fc::hulls

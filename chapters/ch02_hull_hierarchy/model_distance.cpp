#include "ch02_hull_hierarchy/model_distance.hpp"

#include <algorithm>

#include "ch02_hull_hierarchy/box_steps.hpp"

namespace fc::hulls {
namespace {

struct NodePair {
  double lower;  // m, certified gap
  Vec3f normal;  // about unit, world, from A to B
  NodeId a, b;
};

bool leaves(const Model& a, const Model& b, const NodePair& pair) {
  return a.boxes.child(pair.a) < 0 && b.boxes.child(pair.b) < 0;
}

// The four children of the larger node, each with the other node.
template <class Visit>
void open(const Model& a, const Model& b, const PairViews& views, const NodePair& pair, Visit visit) {
  const bool open_a = b.boxes.child(pair.b) < 0 ||
                      (a.boxes.child(pair.a) > 0 && a.boxes.radius(pair.a) >= b.boxes.radius(pair.b));
  const OpenedView& view = open_a ? views.a : views.b;
  const BoxTree& tree = open_a ? a.boxes : b.boxes;
  const int below = tree.child(open_a ? pair.a : pair.b);
  const BoxQuad& quad = tree.quads[below];
  const double sign = open_a ? 1 : -1;
  const Vec3 hint = view.rotation * (sign * pair.normal.cast<double>().normalized());
  const BoxSteps steps = box_steps(quad, open_a ? b.boxes : a.boxes, open_a ? pair.b : pair.a, view,
                                   hint.cast<float>(), {0, 0, 0});
  for (int lane = 0; lane < 4 && quad.child[lane] != 0; ++lane) {
    const Vec3 n(steps.normal.x[lane], steps.normal.y[lane], steps.normal.z[lane]);
    const NodeId child = 4 * below + lane;
    visit(NodePair{
        std::max(pair.lower, steps.gap[lane] - a.radius - b.radius),  // the parent's plane holds for it too

        (sign * (view.rotation.transpose() * n)).cast<float>(), open_a ? child : pair.a,
        open_a ? pair.b : child});
  }
}

struct Farther {  // the queue's top: smallest bound, then the order of the trees
  bool operator()(const NodePair& x, const NodePair& y) const {
    if (x.lower != y.lower) return x.lower > y.lower;
    return x.a != y.a ? x.a > y.a : x.b > y.b;
  }
};

}  // namespace

ca::GjkResult leaf_distance(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& pose,
                            double tolerance) {
  ca::GjkResult g = ca::distance(a, b, pose, {tolerance / 16, 1e-6, 128});
  if (g.status == ca::GjkResult::Status::overlapping) {
    const ca::GjkResult plane = ca::touching_plane(a, b, pose, 16 * tolerance, g.normal);
    if (g.cache.count == 0 || plane.lower > g.lower) g = plane;
  }
  return g;
}

ModelDistance model_distance(const Model& a, const Model& b, const ca::PairPose& pose, double tolerance,
                             double cutoff, double share) {
  ModelDistance result;
  result.upper = result.lower = std::numeric_limits<double>::infinity();
  const PairViews views = views_at_rest(pose);
  std::vector<NodePair> queue{{-std::numeric_limits<double>::infinity(), Vec3f::UnitX(), 0, 0}};
  const auto look = [&](const NodePair& leaf_pair) {
    ++result.leaf_pairs;
    const int leaf_a = ~a.boxes.child(leaf_pair.a), leaf_b = ~b.boxes.child(leaf_pair.b);
    const LeafPair pair{leaf_a, leaf_b, leaf_distance(a.leaf(leaf_a), b.leaf(leaf_b), pose, tolerance)};
    result.upper = std::min(result.upper, pair.gjk.upper);
    if (pair.gjk.lower >= result.lower) return;
    result.lower = pair.gjk.lower;
    if (pair.gjk.lower <= cutoff) result.nearest = pair;
  };
  // First go straight down to two leaves that are near each other: given their distance, most pairs never
  // enter the queue.
  NodePair down = queue.front();
  while (!leaves(a, b, down)) {
    NodePair nearest{std::numeric_limits<double>::infinity(), Vec3f::UnitX(), 0, 0};
    open(a, b, views, down, [&](const NodePair& child) {
      ++result.node_pairs;
      if (child.lower < nearest.lower) nearest = child;
    });
    down = nearest;
  }
  look(down);
  while (!queue.empty()) {
    const NodePair top = queue.front();
    const double enough = std::max(share * result.upper, tolerance);
    if (top.lower >= std::min({result.lower, result.upper, cutoff, enough})) break;
    std::pop_heap(queue.begin(), queue.end(), Farther{});
    queue.pop_back();
    if (!leaves(a, b, top)) {
      open(a, b, views, top, [&](const NodePair& child) {
        ++result.node_pairs;
        if (child.lower >= std::min(result.upper, cutoff)) return;
        queue.push_back(child);
        std::push_heap(queue.begin(), queue.end(), Farther{});
      });
      continue;
    }
    look(top);
  }
  // A pair that was never opened is no nearer than the queue's first, or than the cutoff.
  if (!queue.empty()) result.lower = std::min(result.lower, queue.front().lower);
  result.lower = std::min(result.lower, cutoff);
  return result;
}

std::vector<LeafPair> leaf_pairs_within(const Model& a, const Model& b, const ca::PairPose& pose,
                                        double threshold, double tolerance) {
  std::vector<LeafPair> found;
  const PairViews views = views_at_rest(pose);
  std::vector<NodePair> stack{{-std::numeric_limits<double>::infinity(), Vec3f::UnitX(), 0, 0}};
  while (!stack.empty()) {
    const NodePair top = stack.back();
    stack.pop_back();
    if (!leaves(a, b, top)) {
      open(a, b, views, top, [&](const NodePair& child) {
        if (child.lower <= threshold) stack.push_back(child);
      });
      continue;
    }
    const int leaf_a = ~a.boxes.child(top.a), leaf_b = ~b.boxes.child(top.b);
    const ca::GjkResult g = leaf_distance(a.leaf(leaf_a), b.leaf(leaf_b), pose, tolerance);
    if (g.lower <= threshold) found.push_back({leaf_a, leaf_b, g});
  }
  return found;
}

}  // namespace fc::hulls

#include "ch02_hull_hierarchy/model_distance.hpp"

#include <queue>

namespace fc::hulls {
namespace {

struct NodePair {
  double lower;
  int a, b;
  bool operator<(
      const NodePair& other) const {  // the queue's top: smallest bound, then the order of the trees
    if (lower != other.lower) return lower > other.lower;
    return a != other.a ? a > other.a : b > other.b;
  }
};

// The children of the larger node, each with the other node.
template <class Visit>
void open(const Model& a, const Model& b, int node_a, int node_b, Visit visit) {
  const HullNode& na = a.tree.nodes[node_a];
  const HullNode& nb = b.tree.nodes[node_b];
  if (nb.leaf() || (!na.leaf() && na.radius >= nb.radius)) {
    visit(na.left, node_b);
    visit(na.right, node_b);
  } else {
    visit(node_a, nb.left);
    visit(node_a, nb.right);
  }
}

constexpr ca::GjkOptions kInnerAccuracy{0, 0.05, 128};  // to sort and to cull, bounds within 5 % do

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
                             double cutoff) {
  ModelDistance result;
  result.upper = std::numeric_limits<double>::infinity();
  result.lower = std::numeric_limits<double>::infinity();
  std::priority_queue<NodePair> queue;
  const auto consider = [&](int node_a, int node_b) {
    const HullNode& na = a.tree.nodes[node_a];
    const HullNode& nb = b.tree.nodes[node_b];
    const bool leaves = na.leaf() && nb.leaf();
    ++result.distance_calls;
    LeafPair pair{node_a, node_b, {}};
    if (!leaves) {
      const ca::GjkResult g = ca::distance(a.convex(na), b.convex(nb), pose, kInnerAccuracy);
      if (g.lower < std::min(result.upper, cutoff)) queue.push({g.lower, node_a, node_b});
      return;
    }
    pair.gjk = leaf_distance(a.convex(na), b.convex(nb), pose, tolerance);
    result.upper = std::min(result.upper, pair.gjk.upper);
    if (pair.gjk.lower < result.lower) {
      result.lower = pair.gjk.lower;
      if (pair.gjk.lower <= cutoff) result.nearest = pair;
    }
  };
  consider(0, 0);
  while (!queue.empty()) {
    const NodePair top = queue.top();
    if (top.lower >= std::min(result.lower, cutoff)) break;
    queue.pop();
    open(a, b, top.a, top.b, consider);
  }
  if (result.lower > cutoff) result.lower = std::min(result.lower, cutoff);
  return result;
}

std::vector<LeafPair> leaf_pairs_within(const Model& a, const Model& b, const ca::PairPose& pose,
                                        double threshold, double tolerance) {
  std::vector<LeafPair> found;
  std::vector<std::pair<int, int>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [node_a, node_b] = stack.back();
    stack.pop_back();
    const HullNode& na = a.tree.nodes[node_a];
    const HullNode& nb = b.tree.nodes[node_b];
    if (na.leaf() && nb.leaf()) {
      const ca::GjkResult g = leaf_distance(a.convex(na), b.convex(nb), pose, tolerance);
      if (g.lower <= threshold) found.push_back({node_a, node_b, g});
      continue;
    }
    if (ca::distance(a.convex(na), b.convex(nb), pose, kInnerAccuracy).lower > threshold) continue;
    open(a, b, node_a, node_b, [&](int child_a, int child_b) { stack.push_back({child_a, child_b}); });
  }
  return found;
}

}  // namespace fc::hulls

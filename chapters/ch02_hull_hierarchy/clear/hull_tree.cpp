#include <algorithm>

#include "ch02_hull_hierarchy/clear/pieces.hpp"
#include "common/convex_hull.hpp"

namespace fc::hulls::clear {
namespace {

// ANCHOR: build
constexpr std::size_t kKeepAll = 24;  // points: of this few, finding the inner ones costs more than it saves

Eigen::AlignedBox3d box_of(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

struct TreeBuilder {
  const std::vector<std::vector<Vec3>>& pieces;
  std::vector<Vec3> middles;  // of the pieces' boxes
  std::vector<int> order;     // the pieces, permuted so that a node's are neighbours
  HullTree tree;

  // The node for the pieces order[begin] ... order[end - 1]; its children follow it.
  int build(int begin, int end) {
    const int id = static_cast<int>(tree.nodes.size());
    tree.nodes.emplace_back();
    HullNode node;
    if (end - begin == 1) {
      node.piece = order[begin];
      node.points = pieces[node.piece];
    } else {
      const int half = split(begin, end);
      node.left = build(begin, half);
      node.right = build(half, end);
      join(node, tree.nodes[node.left], tree.nodes[node.right]);
    }
    node.center = box_of(node.points).center();
    for (const Vec3& p : node.points) node.radius = std::max(node.radius, (p - node.center).norm());
    node.radius = node.radius * (1 + 1e-15) + node.slack;
    tree.nodes[id] = std::move(node);
    return id;
  }

  // Moves to the front the half of the pieces that comes first along the longest side of their middles' box.
  int split(int begin, int end) {
    Eigen::AlignedBox3d box;
    for (int k = begin; k < end; ++k) box.extend(middles[order[k]]);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const int half = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end, [&](int i, int j) {
      return middles[i][axis] != middles[j][axis] ? middles[i][axis] < middles[j][axis] : i < j;
    });
    return half;
  }

  // The hull of a union is the hull of the hulls: a node needs its children's points, and of many only the outer ones.
  static void join(HullNode& node, const HullNode& left, const HullNode& right) {
    std::vector<Vec3> points = left.points;
    points.insert(points.end(), right.points.begin(), right.points.end());
    node.slack = std::max(left.slack, right.slack);
    if (points.size() <= kKeepAll) {
      node.points = std::move(points);
      return;
    }
    for (const int i : hull_vertices(points)) node.points.push_back(points[i]);
    node.slack += kHullRounding * box_of(points).sizes().maxCoeff();
  }
};
// ANCHOR_END: build

}  // namespace

// ANCHOR: tree
HullTree hull_tree(const std::vector<std::vector<Vec3>>& pieces) {
  TreeBuilder builder{pieces, {}, {}, {}};
  for (int piece = 0; piece < static_cast<int>(pieces.size()); ++piece) {
    builder.middles.push_back(box_of(pieces[piece]).center());
    builder.order.push_back(piece);
  }
  builder.build(0, static_cast<int>(pieces.size()));
  return std::move(builder.tree);
}
// ANCHOR_END: tree

}  // namespace fc::hulls::clear

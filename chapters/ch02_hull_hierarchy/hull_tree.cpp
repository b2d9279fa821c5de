#include "ch02_hull_hierarchy/hull_tree.hpp"

#include <algorithm>

#include "common/convex_hull.hpp"

namespace fc::hulls {
namespace {

constexpr int kKeepAll = 24;  // points

struct Builder {
  const FeatureMesh& mesh;
  const Lists& pieces;
  std::vector<Vec3> middles;  // of the pieces
  std::vector<int> order;     // the pieces, permuted so that a node's are neighbours
  HullTree tree;

  // The distinct vertices of a piece. A core without triangles (a point, a segment) is one piece of all its
  // vertices.
  std::vector<Vec3> points_of(int piece) const {
    if (mesh.triangles.empty()) return mesh.vertices;
    std::vector<int> ids;
    for (int k = pieces.start[piece]; k < pieces.start[piece + 1]; ++k)
      for (const int v : mesh.triangles[pieces.items[k]]) ids.push_back(v);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    std::vector<Vec3> points;
    for (const int v : ids) points.push_back(mesh.vertices[v]);
    return points;
  }

  void store(HullNode& node, const std::vector<Vec3>& points) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    node.center = box.center();
    for (const Vec3& p : points) node.radius = std::max(node.radius, (p - node.center).norm());
    node.radius = node.radius * (1 + 1e-15) + node.slack;
    node.first_point = static_cast<int>(tree.points.size());
    node.point_count = static_cast<int>(points.size());
    tree.points.insert(tree.points.end(), points.begin(), points.end());
  }

  int build(int begin, int end) {  // returns the node
    const int id = static_cast<int>(tree.nodes.size());
    tree.nodes.emplace_back();
    HullNode node;
    std::vector<Vec3> points;
    if (end - begin == 1) {
      node.piece = order[begin];
      points = points_of(node.piece);
    } else {
      Eigen::AlignedBox3d box;
      for (int k = begin; k < end; ++k) box.extend(middles[order[k]]);
      int axis = 0;
      box.sizes().maxCoeff(&axis);
      const int half = begin + (end - begin) / 2;
      std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end, [&](int i, int j) {
        return middles[i][axis] != middles[j][axis] ? middles[i][axis] < middles[j][axis] : i < j;
      });
      node.left = build(begin, half);
      node.right = build(half, end);
      for (const int child : {node.left, node.right})
        for (const Vec3& p : tree.hull(tree.nodes[child])) points.push_back(p);
      node.slack = std::max(tree.nodes[node.left].slack, tree.nodes[node.right].slack);
    }
    if (node.piece < 0 && static_cast<int>(points.size()) > kKeepAll) {
      Eigen::AlignedBox3d box;
      for (const Vec3& p : points) box.extend(p);
      node.slack += kHullRounding * box.sizes().maxCoeff();
      std::vector<Vec3> hull;
      for (const int i : hull_vertices(points)) hull.push_back(points[i]);
      points = std::move(hull);
    }
    store(node, points);
    tree.nodes[id] = node;
    return id;
  }
};

}  // namespace

HullTree build_hull_tree(const FeatureMesh& mesh, const Lists& pieces) {
  Builder builder{mesh, pieces, {}, {}, {}};
  const int count = std::max(1, static_cast<int>(pieces.start.size()) - 1);
  for (int piece = 0; piece < count; ++piece) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : builder.points_of(piece)) box.extend(p);
    builder.middles.push_back(box.center());
    builder.order.push_back(piece);
  }
  builder.tree.nodes.reserve(2 * count);
  builder.build(0, count);
  return std::move(builder.tree);
}

}  // namespace fc::hulls

// A bounding-volume hierarchy whose volumes are oriented boxes, four children to a node.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ch02_hull_hierarchy/feature_mesh.hpp"
#include "ch02_hull_hierarchy/lanes.hpp"

namespace fc::hulls {

// Four boxes, the children of one node, in single precision: four cache lines. Box k has all points
//   center + s_0 u_0 + s_1 u_1 + s_2 u_2,  |s_i| <= half_i,   u_2 = u_0 x u_1 as floats make it.
// The box is that set, whatever rounding did to its axes: it holds everything below it all the same.
struct alignas(64) BoxQuad {
  Lanes3 center;  // m, shape axes, about the centre of mass
  Lanes3 axis[2];
  Lanes3 half;   // m
  Lanes radius;  // m, of a ball about the centre that holds everything below
  // The quad of the box's own children (> 0), or a leaf (~child), or nothing (0).
  std::array<int, 4> child;
  // Below the box are the leaves first_leaf ... first_leaf + leaf_count - 1.
  std::array<int, 4> first_leaf, leaf_count;
};

// A node is one box of a quad: 4 * (number of the quad) + lane.
using NodeId = int;

// A leaf is a triangle, or the whole of a convex core, or a part of a compound. Its points are stored side by
// side.
struct BoxTree {
  std::vector<BoxQuad> quads;   // quads[0] has the root, in lane 0
  std::vector<int> leaf_item;   // leaf -> triangle, or part; one leaf, -1: the convex core
  std::vector<int> leaf_start;  // leaf -> its first point; one more than there are leaves
  std::vector<Vec3> points;     // m

  std::span<const Vec3> leaf_points(int leaf) const {
    return {points.data() + leaf_start[leaf], points.data() + leaf_start[leaf + 1]};
  }
  int leaves() const { return static_cast<int>(leaf_item.size()); }
  int child(NodeId node) const { return quads[node >> 2].child[node & 3]; }
  float radius(NodeId node) const { return quads[node >> 2].radius[node & 3]; }
};

// Nodes are split at the median of their triangles along the longest side of their box, twice. A box's axes
// are the best of a few: the principal axes of the triangles' area, the shape's axes, those of a triangle.
// "Best" is the smallest surface. `whole`: one leaf for all vertices (a convex core).
BoxTree build_box_tree(const FeatureMesh& mesh, bool whole);
// Over leaves given by points whose hull contains them: a leaf's item is its index in `leaves`.
BoxTree build_box_tree(const std::vector<std::vector<Vec3>>& leaves);

}  // namespace fc::hulls

// A bounding-volume hierarchy whose volumes are convex hulls.
#pragma once

#include <span>
#include <vector>

#include "ch02_hull_hierarchy/feature_mesh.hpp"

namespace fc::hulls {

// A node's hull is given by points that span it; rounded by its slack it contains the hulls of both children,
// so a plane that separates two nodes separates everything below them. A leaf's hull is exact.
struct HullNode {
  Vec3 center = Vec3::Zero();  // m, shape axes, about the centre of mass: the middle of the points' box
  double radius = 0;           // m, the largest distance of a point from the centre, slack included
  double slack = 0;            // m, how far a point that the making of hulls left out may lie outside
  int first_point = 0;         // into HullTree::points
  int point_count = 0;
  int left = -1, right = -1;  // nodes; -1: a leaf
  int piece = -1;             // leaves: the piece

  bool leaf() const { return left < 0; }
};

struct HullTree {
  std::vector<HullNode> nodes;  // the root is node 0
  std::vector<Vec3> points;

  std::span<const Vec3> hull(const HullNode& node) const {
    return {points.data() + node.first_point, static_cast<std::size_t>(node.point_count)};
  }
};

// A binary tree over the pieces, split at the median along the longest side of the box of the pieces'
// middles; hulls from the leaves up: a parent's hull is the hull of its children's hull points. Hulls of at
// most 24 points keep them all: to drop the inner ones costs more than to look at them.
HullTree build_hull_tree(const FeatureMesh& mesh, const Lists& pieces);

}  // namespace fc::hulls

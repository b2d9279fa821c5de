// A model's convex pieces in a hierarchy of convex hulls: the paper's structure.
#pragma once

#include "ch02_hull_hierarchy/hull_tree.hpp"
#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// A convex shape is one piece, and its hierarchy one node; a mesh has its convex pieces.
struct HullModel {
  Lists pieces;  // triangles of each piece (none for a core without triangles)
  HullTree tree;
  double radius = 0, reach = 0;  // m, as Model's

  ca::Convex convex(const HullNode& node) const {
    return {tree.hull(node), radius + node.slack, reach, node.center};
  }
};

// Builds the hulls of a mesh or of a convex polyhedron. Throws std::invalid_argument for a cylinder, a cone or
// a compound: their hulls are not hulls of points.
HullModel build_hull_model(const Model& model);

}  // namespace fc::hulls

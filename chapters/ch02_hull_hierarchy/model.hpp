// A shape made ready for hierarchical collision queries.
#pragma once

#include "ch01_convex_advancement/gjk.hpp"
#include "ch02_hull_hierarchy/feature_mesh.hpp"
#include "ch02_hull_hierarchy/hull_tree.hpp"

namespace fc::hulls {

// A convex shape is one piece, and its hierarchy one node; a mesh has its convex pieces. Coordinates as in
// fc::Shape.
struct Model {
  FeatureMesh mesh;
  Lists pieces;          // triangles of each piece (none for a core without triangles)
  Lists piece_vertices;  // and the vertices and edges of each piece, ascending
  Lists piece_edges;
  HullTree tree;
  double radius = 0;  // m, rounding
  double reach = 0;   // m, of the core about the centre of mass
  bool filled =
      true;  // convex: the hull itself is the solid. false: solid only by its surface's inside, or not at all
  std::vector<int> component_vertex;  // one vertex of each connected component

  ca::Convex convex(const HullNode& node) const {
    return {tree.hull(node), radius + node.slack, reach, node.center};
  }
};

Model build_model(const Shape& shape);

}  // namespace fc::hulls

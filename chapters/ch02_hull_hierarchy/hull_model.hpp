// A model's convex pieces in a hierarchy of convex hulls: what the clear search runs on.
#pragma once

#include <algorithm>

#include "ch02_hull_hierarchy/clear/pieces.hpp"
#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// A convex shape is one piece, and its hierarchy one node; a mesh has its convex pieces.
struct HullModel {
  Lists pieces;  // triangles of each piece (none for a core without triangles)
  HullTree tree;
  double radius = 0, reach = 0;  // m, as Model's

  // A node as a convex shape of its own.
  ca::Convex convex(const HullNode& node) const {
    return {node.points, radius + node.slack, std::min(reach, node.center.norm() + node.radius), node.center};
  }
};

// Builds the hulls of a mesh or of a convex polyhedron. Throws std::invalid_argument for a cylinder, a cone or
// a compound: their hulls are not hulls of points.
HullModel build_hull_model(const Model& model, clear::HullTreeFunction* hull_tree = clear::hull_tree);

// Makes a model ready for the clear search: Model::hulls. Throws as build_hull_model.
void add_hulls(Model& model, const clear::Pieces& pieces);

// The number of points of all nodes' hulls.
std::int64_t points_in(const HullTree& tree);

// Each piece's distinct vertices. A core without triangles (a point, a segment) is one piece of all its vertices.
std::vector<std::vector<Vec3>> points_of_pieces(const FeatureMesh& mesh, const Lists& pieces);

}  // namespace fc::hulls

// A shape made ready for hierarchical collision queries.
#pragma once

#include <memory>

#include "ch01_convex_advancement/gjk.hpp"
#include "ch02_hull_hierarchy/box_tree.hpp"
#include "ch02_hull_hierarchy/feature_mesh.hpp"

namespace fc::hulls {

struct HullModel;

// Coordinates as in fc::Shape. A mesh's leaves are its triangles; a convex shape is one leaf; a compound's
// leaves are its parts.
struct Model {
  FeatureMesh mesh;
  BoxTree boxes;
  double radius = 0;   // m, rounding; of a compound 0: its parts have their own
  double reach = 0;    // m, of the core about the centre of mass; of a compound with the parts' rounding
  bool filled = true;  // convex, or of convex parts: the hulls of the leaves are the solid. false: a mesh,
                       // whose inside is that of its surface, if it has one
  std::vector<double> disks;    // m, of a cylinder or cone: see fc::Shape
  Vec3 axis = Vec3::UnitZ();    // unit: the disks lie across it
  std::vector<Model> parts;     // of a compound, about the whole's centre of mass and along its axes
  std::vector<int> first_name;  // of a compound: a part's features are numbered from here on
  std::vector<int>
      component_triangle;  // one triangle of each connected component; none for a core without any
  std::vector<ca::SupportTable> table;     // one, for a convex shape of many points, or none
  std::shared_ptr<const HullModel> hulls;  // for the clear search (hull_model.hpp), or none

  bool curved() const { return !disks.empty(); }
  const Model& part_of(int leaf) const { return parts[static_cast<std::size_t>(boxes.leaf_item[leaf])]; }

  ca::Convex leaf(int leaf) const {
    if (!parts.empty()) return part_of(leaf).leaf(0);
    if (curved()) return whole();
    const std::span<const Vec3> points = boxes.leaf_points(leaf);
    const Vec3 center = points.size() == 3 ? Vec3((points[0] + points[1] + points[2]) / 3) : middle;
    return {points, radius, reach, center, {}, table.empty() ? nullptr : table.data()};
  }
  Vec3 middle = Vec3::Zero();  // m, of the whole core

  // The whole model as one convex shape; valid for its reach and radius.
  ca::Convex whole() const { return {mesh.vertices, radius, reach, middle, disks, nullptr, axis}; }
};

// Throws std::invalid_argument for a model that reaches less than 1e-12 m or more than 1e15 m (a point may).
Model build_model(const Shape& shape);

}  // namespace fc::hulls

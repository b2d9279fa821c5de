#include "ch02_hull_hierarchy/model.hpp"

#include <algorithm>
#include <numeric>

namespace fc::hulls {
namespace {

constexpr std::size_t kLookAtAll = 16;  // up to this many points a query looks at all of them

std::vector<int> one_triangle_per_component(const FeatureMesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Edge& e : mesh.edges) {
    const int i = root(e.vertex[0]), j = root(e.vertex[1]);
    parent[std::max(i, j)] = std::min(i, j);
  }
  std::vector<int> triangles;
  std::vector<char> seen(mesh.vertices.size(), 0);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    char& known = seen[root(mesh.triangles[t][0])];
    if (!known) triangles.push_back(t);
    known = 1;
  }
  return triangles;
}

// Points whose convex hull contains a convex model, rounding and disks included.
std::vector<Vec3> points_around(const Model& model) {
  std::vector<Vec3> points;
  const Vec3 u = model.axis.unitOrthogonal(), v = model.axis.cross(u);
  for (std::size_t i = 0; i < model.mesh.vertices.size(); ++i)
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
      const double disk = model.curved() ? model.disks[i] : 0;
      points.push_back(model.mesh.vertices[i] + model.radius * sign + disk * (sign.x() * u + sign.y() * v));
      if (model.radius == 0 && disk == 0) break;
    }
  return points;
}

// The first feature number of each part, one part after another. A part has as many numbers as vertices,
// edges or faces, whichever are the most, and at least three, for a cylinder's faces.
std::vector<int> names_of(const std::vector<Model>& parts) {
  std::vector<int> first{0};
  for (const Model& part : parts)
    first.push_back(first.back() +
                    static_cast<int>(std::max({part.mesh.vertices.size(), part.mesh.edges.size(),
                                               part.mesh.triangles.size(), std::size_t{3}})));
  return first;
}

Model build_compound(const Shape& shape) {
  Model model;
  model.mesh = build_feature_mesh(shape.core, true);
  model.reach = shape.reach;
  std::vector<std::vector<Vec3>> around;
  Eigen::AlignedBox3d box;
  for (const Shape& part : shape.parts) {
    model.parts.push_back(build_model(part));
    around.push_back(points_around(model.parts.back()));
    for (const Vec3& p : around.back()) box.extend(p);
  }
  model.middle = box.center();
  model.first_name = names_of(model.parts);
  model.boxes = build_box_tree(around);
  return model;
}

}  // namespace

Model build_model(const Shape& shape) {
  if (!shape.parts.empty()) return build_compound(shape);
  Model model;
  model.mesh = build_feature_mesh(shape.core, shape.solid);
  const FeatureMesh& mesh = model.mesh;
  model.radius = shape.radius;
  model.disks = shape.disks;
  model.axis = shape.axis;
  model.reach = ca::reach_of(mesh.vertices, model.disks, model.axis);
  model.filled = shape.convex();
  model.boxes =
      model.curved() ? build_box_tree({points_around(model)}) : build_box_tree(mesh, shape.convex());
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.vertices) box.extend(p);
  model.middle = box.center();
  if (shape.convex() && mesh.vertices.size() > kLookAtAll) model.table.emplace_back(mesh.vertices);
  model.component_triangle = one_triangle_per_component(mesh);
  return model;
}

}  // namespace fc::hulls

#include "ch02_hull_hierarchy/model.hpp"

#include <algorithm>
#include <numeric>

namespace fc::hulls {
namespace {

constexpr std::size_t kLookAtAll = 16;  // points: of so few all are looked at

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

}  // namespace

Model build_model(const Shape& shape) {
  Model model;
  model.mesh = build_feature_mesh(shape.core, shape.solid);
  const FeatureMesh& mesh = model.mesh;
  model.radius = shape.radius;
  model.reach = ca::reach_of(mesh.vertices);
  model.filled = shape.convex();
  model.boxes = build_box_tree(mesh, shape.convex());
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.vertices) box.extend(p);
  model.middle = box.center();
  if (shape.convex() && mesh.vertices.size() > kLookAtAll) model.table.emplace_back(mesh.vertices);
  model.component_triangle = one_triangle_per_component(mesh);
  return model;
}

}  // namespace fc::hulls

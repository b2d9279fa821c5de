#include "ch02_hull_hierarchy/feature_mesh.hpp"

#include <algorithm>

namespace fc::hulls {
namespace {

// Neighbours whose normals differ by less than this angle (rad) count as one face: far above the rounding of
// a normal (1e-16 times the triangle's aspect ratio), far below any edge that could change a contact's
// direction.
constexpr double kFlatAngle = 1e-7;

Lists lists_of(int count, const std::vector<std::array<int, 2>>& pairs) {  // (list, item), in order of items
  Lists lists;
  lists.start.assign(count + 1, 0);
  for (const auto& [list, item] : pairs) ++lists.start[list + 1];
  for (int i = 0; i < count; ++i) lists.start[i + 1] += lists.start[i];
  lists.items.resize(pairs.size());
  std::vector<int> next(lists.start.begin(), lists.start.end() - 1);
  for (const auto& [list, item] : pairs) lists.items[next[list]++] = item;
  return lists;
}

Vertex kind_of(const FeatureMesh& mesh, int v) {
  std::array<Vec3, 2> along;
  int sharp = 0;
  for (int k = mesh.vertex_edges.start[v]; k < mesh.vertex_edges.start[v + 1]; ++k) {
    const Edge& edge = mesh.edges[mesh.vertex_edges.items[k]];
    if (edge.flat) continue;
    const int other = edge.vertex[0] == v ? edge.vertex[1] : edge.vertex[0];
    if (sharp < 2) along[sharp] = (mesh.vertices[other] - mesh.vertices[v]).normalized();
    ++sharp;
  }
  const bool isolated = mesh.vertex_edges.start[v] == mesh.vertex_edges.start[v + 1];
  if (sharp == 0 && !isolated) return Vertex::on_face;
  const bool straight =
      sharp == 2 && along[0].dot(along[1]) < 0 && along[0].cross(along[1]).norm() < kFlatAngle;
  return straight ? Vertex::on_edge : Vertex::corner;
}

}  // namespace

Vec3 FeatureMesh::inward(int triangle, int edge) const {
  const Vec3& p = vertices[edges[edge].vertex[0]];
  const Vec3 along = vertices[edges[edge].vertex[1]] - p;
  for (const int v : triangles[triangle]) {
    if (v == edges[edge].vertex[0] || v == edges[edge].vertex[1]) continue;
    const Vec3 across = along.cross(normals[triangle]);
    return (across.dot(vertices[v] - p) < 0 ? Vec3(-across) : across).normalized();
  }
  return Vec3::Zero();
}

FeatureMesh build_feature_mesh(const TriangleMesh& core, bool solid) {
  FeatureMesh mesh;
  mesh.vertices = core.vertices;
  mesh.triangles = core.triangles;
  mesh.solid = solid;
  for (const auto& [i, j, k] : core.triangles) {
    const Vec3& p = core.vertices[i];
    mesh.normals.push_back((core.vertices[j] - p).cross(core.vertices[k] - p).normalized());
  }

  struct Side {
    int low, high, triangle;
  };
  std::vector<Side> sides;
  sides.reserve(3 * core.triangles.size());
  for (int t = 0; t < static_cast<int>(core.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int i = core.triangles[t][k], j = core.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(i, j), std::max(i, j), t});
    }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return x.low != y.low ? x.low < y.low : x.high < y.high;
  });

  std::vector<std::array<int, 2>> edge_triangle, triangle_edge, vertex_edge;
  for (const Side& s : sides) {
    if (mesh.edges.empty() || mesh.edges.back().vertex != std::array{s.low, s.high}) {
      mesh.edges.push_back({{s.low, s.high}, false});
    }
    const int e = static_cast<int>(mesh.edges.size()) - 1;
    edge_triangle.push_back({e, s.triangle});
    triangle_edge.push_back({s.triangle, e});
  }
  if (core.triangles.empty() && core.vertices.size() == 2) mesh.edges.push_back({{0, 1}, false});
  for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e)
    for (const int v : mesh.edges[e].vertex) vertex_edge.push_back({v, e});

  mesh.edge_triangles = lists_of(static_cast<int>(mesh.edges.size()), edge_triangle);
  mesh.triangle_edges = lists_of(static_cast<int>(mesh.triangles.size()), triangle_edge);
  mesh.vertex_edges = lists_of(static_cast<int>(mesh.vertices.size()), vertex_edge);
  for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e) {
    const int first = mesh.edge_triangles.start[e];
    if (mesh.edge_triangles.start[e + 1] - first != 2) continue;
    const Vec3& n = mesh.normals[mesh.edge_triangles.items[first]];
    const Vec3& m = mesh.normals[mesh.edge_triangles.items[first + 1]];
    mesh.edges[e].flat = n.cross(m).norm() < kFlatAngle && n.dot(m) > 0;
  }
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v)
    mesh.vertex_kind.push_back(kind_of(mesh, v));
  return mesh;
}

}  // namespace fc::hulls

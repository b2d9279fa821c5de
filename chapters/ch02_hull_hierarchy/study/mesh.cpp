#include "ch02_hull_hierarchy/study/mesh.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <queue>
#include <vector>

namespace fc::hulls {
namespace {

class Decimation {
 public:
  explicit Decimation(const TriangleMesh& mesh)
      : vertices(mesh.vertices),
        triangles(mesh.triangles),
        around(mesh.vertices.size()),
        changes(mesh.vertices.size()) {
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
      for (const int v : triangles[t]) around[v].push_back(t);
    for (const auto& t : triangles)
      for (int k = 0; k < 3; ++k) push(t[k], t[(k + 1) % 3]);
  }

  TriangleMesh to(std::size_t target) {
    std::size_t left = triangles.size();
    for (; left > target && !queue.empty(); queue.pop()) {
      const Edge edge = queue.top();
      const bool current = edge.changes == changes[edge.a] + changes[edge.b] && is_edge(edge.a, edge.b);
      if (!current || !may_collapse(edge.a, edge.b)) continue;
      collapse(edge.a, edge.b);
      left -= 2;
    }
    return remaining();
  }

 private:
  struct Edge {
    double length;
    int a, b;
    int changes;  // of both ends, when this was pushed
    bool operator<(const Edge& other) const { return length > other.length; }
  };
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;  // removed ones are {-1, -1, -1}
  std::vector<std::vector<int>> around;       // the triangles at each vertex
  std::vector<int> changes;                   // how often each vertex was moved, or lost
  std::priority_queue<Edge> queue;

  void push(int a, int b) {
    if (a < b) queue.push({(vertices[a] - vertices[b]).norm(), a, b, changes[a] + changes[b]});
  }
  std::vector<int> neighbours(int v) const {
    std::vector<int> all;
    for (const int t : around[v])
      for (const int w : triangles[t])
        if (w != v) all.push_back(w);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }
  bool has(int triangle, int v) const {
    return std::find(triangles[triangle].begin(), triangles[triangle].end(), v) != triangles[triangle].end();
  }
  bool is_edge(int a, int b) const {
    return std::any_of(around[a].begin(), around[a].end(), [&](int t) { return has(t, b); });
  }
  Vec3 normal(int triangle, int moved, const Vec3& to) const {
    std::array<Vec3, 3> p;
    for (int k = 0; k < 3; ++k) {
      const int v = triangles[triangle][k];
      p[k] = v == moved ? to : vertices[v];
    }
    return (p[1] - p[0]).cross(p[2] - p[0]);
  }
  bool turns_over(int v, int other, const Vec3& middle) const {
    return std::any_of(around[v].begin(), around[v].end(), [&](int t) {
      if (has(t, other)) return false;
      const Vec3 before = normal(t, v, vertices[v]), after = normal(t, v, middle);
      return !(before.dot(after) > 0.2 * before.norm() * after.norm());
    });
  }
  bool may_collapse(int a, int b) const {
    const std::vector<int> of_a = neighbours(a), of_b = neighbours(b);
    std::vector<int> common;
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
    const Vec3 middle = 0.5 * (vertices[a] + vertices[b]);
    return common.size() == 2 && !turns_over(a, b, middle) && !turns_over(b, a, middle);
  }
  void collapse(int a, int b) {
    vertices[a] = 0.5 * (vertices[a] + vertices[b]);
    for (const int t : around[b]) {
      if (has(t, a)) {
        for (const int v : triangles[t])
          if (v != b) around[v].erase(std::find(around[v].begin(), around[v].end(), t));
        triangles[t] = {-1, -1, -1};
      } else {
        std::replace(triangles[t].begin(), triangles[t].end(), b, a);
        around[a].push_back(t);
      }
    }
    around[b].clear();
    ++changes[a];
    ++changes[b];
    for (const int v : neighbours(a)) push(std::min(a, v), std::max(a, v));
  }
  TriangleMesh remaining() const {
    TriangleMesh mesh;
    std::vector<int> number(vertices.size(), -1);
    for (auto t : triangles) {
      if (t[0] < 0) continue;
      for (int& v : t) {
        if (number[v] < 0) {
          number[v] = static_cast<int>(mesh.vertices.size());
          mesh.vertices.push_back(vertices[v]);
        }
        v = number[v];
      }
      mesh.triangles.push_back(t);
    }
    return mesh;
  }
};

}  // namespace

TriangleMesh decimated(const TriangleMesh& mesh, std::size_t target) {
  return Decimation(mesh).to(target);
}

Shape mesh_shape(const std::filesystem::path& file) {
  ShapeSpec spec;
  spec.name = file.stem().string();
  spec.geometry = MeshSpec{file};
  return build_shape(spec, 0);
}

Shape coarser(const Shape& shape, std::size_t triangles) {
  Shape coarse = shape;
  const PreparedMesh prepared = prepare_mesh(decimated(shape.core, triangles));
  coarse.core = prepared.mesh;
  coarse.report = prepared.report;
  coarse.solid = prepared.report.solid;
  coarse.reach = 0;
  for (const Vec3& v : coarse.core.vertices) coarse.reach = std::max(coarse.reach, v.norm());
  return coarse;
}

double size_of(const Shape& shape) {
  const double inf = std::numeric_limits<double>::infinity();
  Vec3 low = Vec3::Constant(inf), high = Vec3::Constant(-inf);
  for (const Vec3& v : shape.core.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).maxCoeff();
}

}  // namespace fc::hulls

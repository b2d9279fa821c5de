// The queries of bench_ch02: two bunnies, the same for every engine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <queue>
#include <random>
#include <utility>
#include <vector>

#include "ch02_hull_hierarchy/advance.hpp"
#include "common/shape.hpp"

namespace fc::bench {

// meshes
// -------------------------------------------------------------------------------------------------------

// Collapses the shortest edges of a closed mesh to their middles until `target` triangles are left, or no
// edge can go: the mesh stays closed and without crossing itself locally (an edge's ends must have two common
// neighbours, and no triangle may turn over).
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
  std::vector<std::array<int, 3>> triangles;  // those that are gone are {-1, -1, -1}
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

// Debian's package glmark2-data has it: 69,666 triangles, closed.
inline Shape bunny_shape() {
  ShapeSpec spec;
  spec.name = "bunny";
  spec.geometry = MeshSpec{"/usr/share/glmark2/models/bunny.obj"};
  return build_shape(spec, 0);
}

// The same with about so many triangles, still closed.
inline Shape coarser(const Shape& shape, std::size_t triangles) {
  Shape coarse = shape;
  const PreparedMesh prepared = prepare_mesh(Decimation(shape.core).to(triangles));
  coarse.core = prepared.mesh;
  coarse.report = prepared.report;
  coarse.solid = prepared.report.solid;
  coarse.reach = 0;
  for (const Vec3& v : coarse.core.vertices) coarse.reach = std::max(coarse.reach, v.norm());
  return coarse;
}

// The longest side of its box, m.
inline double size_of(const Shape& shape) {
  const double inf = std::numeric_limits<double>::infinity();
  Vec3 low = Vec3::Constant(inf), high = Vec3::Constant(-inf);
  for (const Vec3& v : shape.core.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).maxCoeff();
}

// queries
// ------------------------------------------------------------------------------------------------------

struct BunnyPair {
  ca::Motion a, b;
};

// Random motions of one second, in units of the bunny's size.
class BunnyPairs {
 public:
  BunnyPairs(const hulls::Model& bunny, double bunny_size, std::uint64_t seed)
      : model(bunny), size(bunny_size), random(seed) {}

  // A at the origin, B 1.1 to 2.5 away, no nearer than 0.05 to A's surface. Both fly towards each other's
  // neighbourhood, so that about half of the pairs meet, and turn by up to 1.5 rad.
  BunnyPair far() {
    while (true) {
      const Vec3 apart = size * uniform(1.1, 2.5) * direction();
      const Vec3 aim = size * uniform(0, 2.9) * direction();  // where B would come to, seen from A
      const Vec3 relative = uniform(0.9, 1.5) * (aim - apart), velocity_b = uniform(0.2, 0.8) * relative;
      BunnyPair pair{body(Vec3::Zero()), body(apart)};
      pair.a.velocity = velocity_b - relative;
      pair.b.velocity = velocity_b;
      spin(pair.a, uniform(0, 1.5));
      spin(pair.b, uniform(0, 1.5));
      if (distance(pair).upper > 0.05 * size) return pair;
    }
  }
  // A first gap of 1e-3 to 2e-2, evenly in its logarithm; B moves by 0.1 to 0.6, rather towards A than away,
  // so that three quarters of the pairs meet; both turn by up to 0.75 rad.
  BunnyPair close() {
    const Vec3 line = direction();
    BunnyPair pair = near(std::exp(uniform(std::log(1e-3), std::log(2e-2))), line);
    const Vec3 relative = size * uniform(0.1, 0.6) * (direction() - 0.4 * line).normalized();
    pair.b.velocity = uniform(0.2, 0.8) * relative;
    pair.a.velocity = pair.b.velocity - relative;
    spin(pair.a, uniform(0, 0.75));
    spin(pair.b, uniform(0, 0.75));
    return pair;
  }
  // Both turn by 1.2 rad on the spot, at a first gap of 1e-4.
  BunnyPair spinning() {
    BunnyPair pair = near(1e-4, direction());
    spin(pair.a, 1.2);
    spin(pair.b, 1.2);
    return pair;
  }

 private:
  const hulls::Model& model;
  const double size;
  std::mt19937_64 random;

  double uniform(double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  }
  Vec3 direction() {
    while (true) {
      const Vec3 d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (d.norm() > 0.1 && d.norm() < 1) return d.normalized();
    }
  }
  ca::Motion body(const Vec3& position) {
    ca::Motion motion;
    motion.position = position;
    const Vec3 axis = direction();
    motion.rotation = ca::rotation_about(axis, uniform(0, 3));
    return motion;
  }
  void spin(ca::Motion& motion, double rate) {
    motion.spin_axis = direction();
    motion.spin_rate = rate;
    motion.spin = rate * motion.spin_axis;
  }
  hulls::ModelDistance distance(const BunnyPair& pair) const {
    return hulls::model_distance(model, model, ca::PairPose(pair.a, pair.b, 0), 1e-9 * size);
  }
  // B comes along a line through both centres until the gap is `gap`. Each step is what the gap has too much:
  // it never falls below.
  BunnyPair near(double gap, const Vec3& line) {
    BunnyPair pair{body(Vec3::Zero()), body(3 * size * line)};
    while (true) {
      const double step = distance(pair).upper - gap * size;
      if (step < 1e-3 * gap * size) return pair;
      pair.b.position -= step * line;
    }
  }
};

}  // namespace fc::bench

// Meshes with names for what is hard about them, and models of them for chapter 2.
#pragma once

#include "ch02_hull_hierarchy/model.hpp"
#include "tests/support/random_shapes.hpp"

namespace fc::test {

inline hulls::Model model_of(const TriangleMesh& mesh, bool solid = true) {
  Shape shape;
  shape.kind = Shape::Kind::mesh;
  shape.core = mesh;
  shape.solid = solid;
  shape.reach = ca::reach_of(mesh.vertices);
  return hulls::build_model(shape);
}

// As common/shape.hpp has them: a point and a segment have no triangles.
inline hulls::Model model_of(const Solid& solid) {
  Shape shape;
  shape.kind = Shape::Kind::hull;
  shape.core = solid.core;
  if (shape.core.vertices.size() < 3) shape.core.triangles.clear();
  shape.radius = solid.radius;
  shape.reach = solid.reach();
  return hulls::build_model(shape);
}

// A prism over a polygon (counter-clockwise) all of which can be seen from `kernel`.
inline TriangleMesh prism(const std::vector<std::array<double, 2>>& polygon, std::array<double, 2> kernel,
                          double height) {
  TriangleMesh mesh;
  const int n = static_cast<int>(polygon.size());
  for (const double z : {-height / 2, height / 2}) {
    for (const auto& [x, y] : polygon) mesh.vertices.emplace_back(x, y, z);
    mesh.vertices.emplace_back(kernel[0], kernel[1], z);
  }
  for (int i = 0; i < n; ++i) {
    const int k = (i + 1) % n, up = n + 1;
    mesh.triangles.push_back({n, k, i});
    mesh.triangles.push_back({up + n, up + i, up + k});
    mesh.triangles.push_back({i, k, up + k});
    mesh.triangles.push_back({i, up + k, up + i});
  }
  return mesh;
}
inline TriangleMesh l_prism() {
  return prism({{-0.5, -0.5}, {1, -0.5}, {1, 0}, {0, 0}, {0, 1}, {-0.5, 1}}, {-0.25, -0.25}, 0.5);
}
inline TriangleMesh star(int spikes, double height) {
  std::vector<std::array<double, 2>> polygon;
  for (int i = 0; i < 2 * spikes; ++i) {
    const double phi = std::numbers::pi * i / spikes, r = i % 2 ? 0.4 : 1;
    polygon.push_back({r * std::cos(phi), r * std::sin(phi)});
  }
  return prism(polygon, {0, 0}, height);
}

// A ring around z: `around` times `across` four-sided faces; 4 and 4 make a square frame with a tunnel.
inline TriangleMesh ring(double big, double small, int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * (k + 0.5) / across;
      const double r = big + small * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), small * std::sin(v));
    }
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const int j = (i + 1) % around * across, m = (k + 1) % across;
      mesh.triangles.push_back({i * across + k, j + k, j + m});
      mesh.triangles.push_back({i * across + k, j + m, i * across + m});
    }
  return mesh;
}

inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b, bool reversed) {
  const int shift = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) {
    if (reversed)
      a.triangles.push_back({i + shift, k + shift, j + shift});
    else
      a.triangles.push_back({i + shift, j + shift, k + shift});
  }
  return a;
}
inline TriangleMesh cube_with_cavity() {
  return joined(box_core({1, 1, 1}), box_core({0.6, 0.6, 0.6}), true);
}
// A ball with bumps and dents.
inline TriangleMesh bumpy_ball(Random& random, int rings) {
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, 1);
  const int around = 2 * rings;
  for (int i = 1; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double u = std::numbers::pi * i / rings, v = 2 * std::numbers::pi * k / around;
      mesh.vertices.push_back(uniform(random, 0.7, 1) *
                              Vec3(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)));
    }
  mesh.vertices.emplace_back(0, 0, -1);
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int i, int k) { return 1 + (i - 1) * around + k % around; };
  for (int k = 0; k < around; ++k) {
    mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
    mesh.triangles.push_back({at(rings - 1, k), last, at(rings - 1, k + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}
// Triangles anywhere in a ball, needles among them: no inside.
inline TriangleMesh triangle_soup(Random& random, int count) {
  TriangleMesh mesh;
  for (int t = 0; t < count; ++t) {
    const Vec3 middle = uniform(random, 0, 0.7) * unit_vector(random), u = unit_vector(random),
               v = unit_vector(random);
    const double thin = integer(random, 0, 3) ? 0.3 : 1e-6;
    mesh.vertices.push_back(middle);
    mesh.vertices.push_back(middle + 0.3 * u);
    mesh.vertices.push_back(middle + 0.15 * u + thin * v);
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

// How often a surface winds around a point: the sum of the signed solid angles of its triangles.
inline double windings(const TriangleMesh& mesh, const Vec3& x) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = (mesh.vertices[t[0]] - x).normalized(), b = (mesh.vertices[t[1]] - x).normalized(),
               c = (mesh.vertices[t[2]] - x).normalized();
    sum += 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace fc::test

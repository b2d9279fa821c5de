#include "support/independent_gap.hpp"

#include <algorithm>
#include <limits>

namespace independent {
namespace {

constexpr int kManyTriangles = 3000;  // above: a tree, and crossing or not in place of a distance

Rounded from(const Mesh& mesh, double radius, bool closed) {
  Rounded shape;
  shape.core = mesh;
  shape.radius = radius;
  shape.closed = closed;
  for (const Vec& x : mesh.vertices) shape.reach = std::max(shape.reach, norm(x));
  return shape;
}

Vec placed(const State& state, const Matrix& turn, const Vec& x) {
  return state.position + turn * x;
}

double clamped(double x) {
  return std::min(1.0, std::max(0.0, x));
}

double point_to_segment(const Vec& p, const Vec& a, const Vec& b) {
  const Vec ab = b - a;
  const double length2 = dot(ab, ab);
  const double s = length2 > 0 ? clamped(dot(p - a, ab) / length2) : 0;
  return norm(p - (a + s * ab));
}

double point_to_triangle(const Vec& p, const std::array<Vec, 3>& t) {
  double best = std::min(
      {point_to_segment(p, t[0], t[1]), point_to_segment(p, t[1], t[2]), point_to_segment(p, t[2], t[0])});
  const Vec n = cross(t[1] - t[0], t[2] - t[0]);
  const double area2 = dot(n, n);
  if (!(area2 > 0)) return best;
  for (int i = 0; i < 3; ++i)  // beside an edge the edges tell
    if (dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), n) < 0) return best;
  return std::min(best, std::abs(dot(p - t[0], n)) / std::sqrt(area2));
}

double segment_to_segment(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  double best = std::min({point_to_segment(a, c, d), point_to_segment(b, c, d), point_to_segment(c, a, b),
                          point_to_segment(d, a, b)});
  const Vec u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return best;
  const double s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
  if (s < 0 || s > 1 || t < 0 || t > 1) return best;
  return std::min(best, norm((a + s * u) - (c + t * v)));
}

bool is_point(const std::array<Vec, 3>& t) {
  return norm(cross(t[1] - t[0], t[2] - t[0])) == 0;
}

std::vector<std::array<Vec, 3>> world_triangles(const Rounded& shape, const State& state) {
  const Matrix turn = rotation(state.orientation);
  std::vector<std::array<Vec, 3>> triangles;
  for (const auto& t : shape.core.triangles)
    triangles.push_back({placed(state, turn, shape.core.vertices[t[0]]),
                         placed(state, turn, shape.core.vertices[t[1]]),
                         placed(state, turn, shape.core.vertices[t[2]])});
  return triangles;
}

bool inside(const std::vector<std::array<Vec, 3>>& triangles, const Vec& point) {
  return std::abs(winding(triangles, point)) > 0.5;
}

}  // namespace

Rounded rounded_ball(double radius) {
  return from({{{0, 0, 0}}, {{0, 0, 0}}}, radius, false);
}

Rounded rounded_rod(double radius, double length) {
  return from({{{0, 0, -length / 2}, {0, 0, length / 2}}, {{0, 1, 1}}}, radius, false);
}

Rounded rounded_block(const Vec& size) {
  return from(box(size), 0, true);
}

// The faces are fans of the points that lie in a plane with nothing in front of it.
Rounded rounded_hull(const std::vector<Vec>& points) {
  Mesh mesh{points, {}};
  const int n = static_cast<int>(points.size());
  std::vector<Vec> normals_done;
  std::vector<double> offsets_done;
  double size = 0;
  for (const Vec& x : points) size = std::max(size, norm(x));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        if (i == j || j == k || k == i) continue;
        Vec normal = cross(points[j] - points[i], points[k] - points[i]);
        if (norm(normal) < 1e-9 * size * size) continue;
        normal = (1 / norm(normal)) * normal;
        const double offset = dot(normal, points[i]);
        bool outer = true;
        for (const Vec& x : points) outer = outer && dot(normal, x) <= offset + 1e-9 * size;
        bool done = false;
        for (std::size_t m = 0; m < normals_done.size(); ++m)
          done = done || (dot(normals_done[m], normal) > 1 - 1e-9 &&
                          std::abs(offsets_done[m] - offset) < 1e-9 * size);
        if (!outer || done) continue;
        normals_done.push_back(normal);
        offsets_done.push_back(offset);
        std::vector<int> face;
        Vec middle;
        for (int m = 0; m < n; ++m)
          if (dot(normal, points[m]) >= offset - 1e-9 * size) {
            face.push_back(m);
            middle = middle + points[m];
          }
        middle = (1.0 / static_cast<double>(face.size())) * middle;
        const Vec x = points[face[0]] - middle, y = cross(normal, x);
        std::sort(face.begin(), face.end(), [&](int p, int q) {
          const Vec a = points[p] - middle, b = points[q] - middle;
          return std::atan2(dot(a, y), dot(a, x)) < std::atan2(dot(b, y), dot(b, x));
        });
        for (std::size_t m = 1; m + 1 < face.size(); ++m)
          mesh.triangles.push_back({face[0], face[m], face[m + 1]});
      }
  return from(mesh, 0, true);
}

Rounded rounded_mesh(const Mesh& mesh) {
  Rounded shape = from(mesh, 0, true);
  if (static_cast<int>(mesh.triangles.size()) > kManyTriangles) shape.tree = make_solid(mesh, 1);
  return shape;
}

double distance(const std::array<Vec, 3>& a, const std::array<Vec, 3>& b) {
  if (!is_point(a) && !is_point(b) && triangles_cross(a, b)) return 0;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    best = std::min({best, point_to_triangle(a[i], b), point_to_triangle(b[i], a)});
    for (int k = 0; k < 3; ++k)
      best = std::min(best, segment_to_segment(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  if (is_point(a) != is_point(b)) {  // a segment through a triangle
    const auto& thin = is_point(a) ? a : b;
    const auto& wide = is_point(a) ? b : a;
    const Vec n = cross(wide[1] - wide[0], wide[2] - wide[0]);
    const double s0 = dot(n, thin[0] - wide[0]), s1 = dot(n, thin[1] - wide[0]);
    if (s0 * s1 < 0) {
      const Vec p = thin[0] + (s0 / (s0 - s1)) * (thin[1] - thin[0]);
      if (point_to_triangle(p, wide) <= 1e-15 * norm(thin[1] - thin[0])) return 0;
    }
  }
  return best;
}

bool apart(const Rounded& a, const State& at_a, const Rounded& b, const State& at_b, double allowed) {
  if (a.tree && b.tree) return !overlap(*a.tree, at_a, *b.tree, at_b);
  if (norm(at_b.position - at_a.position) > a.reach + a.radius + b.reach + b.radius) return true;
  const auto triangles_a = world_triangles(a, at_a), triangles_b = world_triangles(b, at_b);
  const double radii = a.radius + b.radius;
  for (const auto& s : triangles_a) {
    Vec low = s[0], high = s[0];
    for (const Vec& x : s) {
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    for (const auto& t : triangles_b) {
      const auto away = [&](double l, double h, double p, double q, double r) {
        return std::min({p, q, r}) > h + radii || std::max({p, q, r}) < l - radii;
      };
      if (away(low.x, high.x, t[0].x, t[1].x, t[2].x) || away(low.y, high.y, t[0].y, t[1].y, t[2].y) ||
          away(low.z, high.z, t[0].z, t[1].z, t[2].z))
        continue;
      if (radii > 0 ? distance(s, t) < radii - allowed : triangles_cross(s, t)) return false;
    }
  }
  return !(a.closed && inside(triangles_a, triangles_b[0][0])) &&
         !(b.closed && inside(triangles_b, triangles_a[0][0]));
}

}  // namespace independent

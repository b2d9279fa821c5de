#include "support/independent_overlap.hpp"

#include <algorithm>
#include <numeric>

namespace independent {
namespace {

constexpr double kTouching = 1e-12;  // m; the engine keeps gaps above 1e-9 m

struct Placement {  // of B in A's axes about A's centroid
  Matrix turn;
  Vec shift;
  Vec operator()(const Vec& x) const { return turn * x + shift; }
};

Placement placement(const Solid& a, const State& at_a, const Solid& b, const State& at_b) {
  const Matrix back = transposed(rotation(at_a.orientation));
  return {back * rotation(at_b.orientation), back * (center(b, at_b) - center(a, at_a))};
}

std::array<Vec, 3> corners(const Solid& solid, int triangle) {
  const auto& t = solid.mesh.triangles[triangle];
  return {solid.mesh.vertices[t[0]], solid.mesh.vertices[t[1]], solid.mesh.vertices[t[2]]};
}

bool apart(double middle, double half) {
  return std::abs(middle) > half + kTouching;
}

bool spans_meet(double a0, double a1, double a2, double b0, double b1, double b2) {
  return std::min({a0, a1, a2}) <= std::max({b0, b1, b2}) + kTouching &&
         std::min({b0, b1, b2}) <= std::max({a0, a1, a2}) + kTouching;
}

bool edge_crosses(const Vec& p, const Vec& q, const std::array<Vec, 3>& t, const Vec& normal, double length) {
  const double from = dot(normal, p - t[0]), to = dot(normal, q - t[0]), slack = kTouching * length;
  if ((from > slack && to > slack) || (from < -slack && to < -slack)) return false;
  if (std::abs(from) <= slack && std::abs(to) <= slack) return false;  // in the plane: other edges will tell
  const Vec along = q - p;
  bool left = true, right = true;
  for (int i = 0; i < 3; ++i) {
    const Vec edge = t[(i + 1) % 3] - t[i];
    const double side = dot(along, cross(t[i] - p, edge)), room = kTouching * norm(along) * norm(edge);
    left &= side >= -room;
    right &= side <= room;
  }
  return left || right;
}

bool nodes_cross(const Solid& a, int node_a, const Solid& b, int node_b, const Placement& place) {
  const Node& n = a.tree[node_a];
  const Node& m = b.tree[node_b];
  const Vec middle = place(m.middle) - n.middle;
  const auto half = [&](int row) {
    const Vec& r = place.turn[row];
    return std::abs(r.x) * m.half.x + std::abs(r.y) * m.half.y + std::abs(r.z) * m.half.z;
  };
  if (apart(middle.x, n.half.x + half(0)) || apart(middle.y, n.half.y + half(1)) ||
      apart(middle.z, n.half.z + half(2)))
    return false;
  if (n.left < 0 && m.left < 0) {
    for (int j = m.begin; j < m.end; ++j) {
      std::array<Vec, 3> t = corners(b, b.order[j]);
      for (Vec& x : t) x = place(x);
      for (int i = n.begin; i < n.end; ++i)
        if (triangles_cross(corners(a, a.order[i]), t)) return true;
    }
    return false;
  }
  if (m.left < 0 || (n.left >= 0 && norm(n.half) > norm(m.half)))
    return nodes_cross(a, n.left, b, node_b, place) || nodes_cross(a, n.right, b, node_b, place);
  return nodes_cross(a, node_a, b, m.left, place) || nodes_cross(a, node_a, b, m.right, place);
}

bool any_triangles_cross(const Solid& a, const Solid& b, const Placement& place) {
  std::vector<Vec> moved_b;
  for (const Vec& x : b.mesh.vertices) moved_b.push_back(place(x));
  for (const auto& t : b.mesh.triangles)
    for (int i = 0; i < static_cast<int>(a.mesh.triangles.size()); ++i)
      if (triangles_cross(corners(a, i), {moved_b[t[0]], moved_b[t[1]], moved_b[t[2]]})) return true;
  return false;
}

int build(Solid& solid, int begin, int end) {
  Vec low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (int i = begin; i < end; ++i)
    for (const Vec& x : corners(solid, solid.order[i])) {
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
  const int index = static_cast<int>(solid.tree.size());
  solid.tree.push_back({0.5 * (low + high), 0.5 * (high - low), -1, -1, begin, end});
  if (end - begin <= 4) return index;
  const Vec half = solid.tree[index].half;
  const auto key = [&](int triangle) {
    const auto c = corners(solid, triangle);
    const Vec sum = c[0] + c[1] + c[2];
    return half.x >= half.y && half.x >= half.z ? sum.x : half.y >= half.z ? sum.y : sum.z;
  };
  const int split = (begin + end) / 2;
  std::nth_element(solid.order.begin() + begin, solid.order.begin() + split, solid.order.begin() + end,
                   [&](int s, int t) { return key(s) < key(t); });
  const int left = build(solid, begin, split), right = build(solid, split, end);
  solid.tree[index].left = left;
  solid.tree[index].right = right;
  return index;
}

}  // namespace

bool triangles_cross(const std::array<Vec, 3>& a, const std::array<Vec, 3>& b) {
  if (!spans_meet(a[0].x, a[1].x, a[2].x, b[0].x, b[1].x, b[2].x) ||
      !spans_meet(a[0].y, a[1].y, a[2].y, b[0].y, b[1].y, b[2].y) ||
      !spans_meet(a[0].z, a[1].z, a[2].z, b[0].z, b[1].z, b[2].z))
    return false;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const Vec normal = cross((*other)[1] - (*other)[0], (*other)[2] - (*other)[0]);
    const double length = norm(normal);
    for (int i = 0; i < 3; ++i)
      if (edge_crosses((*one)[i], (*one)[(i + 1) % 3], *other, normal, length)) return true;
  }
  return false;
}

bool overlap(const Solid& a, const State& at_a, const Solid& b, const State& at_b, How how) {
  if (norm(center(b, at_b) - center(a, at_a)) > a.reach + b.reach) return false;
  const Placement place = placement(a, at_a, b, at_b);
  if (how == How::tree ? nodes_cross(a, 0, b, 0, place) : any_triangles_cross(a, b, place)) return true;
  const Vec of_a = center(a, at_a) + rotation(at_a.orientation) * a.mesh.vertices[0];
  const Vec of_b = center(b, at_b) + rotation(at_b.orientation) * b.mesh.vertices[0];
  return winding(a, at_a, of_b) > 0.5 || winding(b, at_b, of_a) > 0.5;
}

// The solid angle of each triangle, by its spherical excess: the sum of the angles between the planes through
// the point.
double winding(const std::vector<std::array<Vec, 3>>& triangles, const Vec& point) {
  double sum = 0;
  for (std::array<Vec, 3> t : triangles) {
    for (Vec& x : t) x = x - point;
    const double a = norm(t[0]), b = norm(t[1]), c = norm(t[2]);
    sum += 2 * std::atan2(dot(t[0], cross(t[1], t[2])),
                          a * b * c + dot(t[0], t[1]) * c + dot(t[1], t[2]) * a + dot(t[2], t[0]) * b);
  }
  return sum / (4 * std::acos(-1.0));
}

double winding(const Solid& solid, const State& state, const Vec& point) {
  const Vec local = transposed(rotation(state.orientation)) * (point - center(solid, state));
  if (norm(local) > solid.reach) return 0;
  std::vector<std::array<Vec, 3>> triangles;
  for (int i = 0; i < static_cast<int>(solid.mesh.triangles.size()); ++i)
    triangles.push_back(corners(solid, i));
  return winding(triangles, local);
}

Solid make_solid(const Mesh& mesh, double density) {
  Solid solid;
  solid.mesh = mesh;
  const Vec origin = mesh.vertices[0];
  double volume = 0;
  Vec first;
  for (const auto& t : mesh.triangles) {
    const Vec a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin,
              c = mesh.vertices[t[2]] - origin;
    const double v = dot(a, cross(b, c)) / 6;
    volume += v;
    first = first + (v / 4) * (a + b + c);
  }
  solid.centroid = origin + (1 / volume) * first;
  solid.mass = density * volume;
  for (Vec& x : solid.mesh.vertices) {
    x = x - solid.centroid;
    solid.reach = std::max(solid.reach, norm(x));
  }
  // Second moments of tetrahedra (0, a, b, c): v/20 (sum of squares + square of the sum), entry by entry.
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  for (const auto& t : mesh.triangles) {
    const auto& x = solid.mesh.vertices;
    const Vec a = x[t[0]], b = x[t[1]], c = x[t[2]], s = a + b + c;
    const double m = density * dot(a, cross(b, c)) / 120;
    xx += m * (a.x * a.x + b.x * b.x + c.x * c.x + s.x * s.x);
    yy += m * (a.y * a.y + b.y * b.y + c.y * c.y + s.y * s.y);
    zz += m * (a.z * a.z + b.z * b.z + c.z * c.z + s.z * s.z);
    xy += m * (a.x * a.y + b.x * b.y + c.x * c.y + s.x * s.y);
    yz += m * (a.y * a.z + b.y * b.z + c.y * c.z + s.y * s.z);
    zx += m * (a.z * a.x + b.z * b.x + c.z * c.x + s.z * s.x);
  }
  solid.inertia = {Vec{yy + zz, -xy, -zx}, Vec{-xy, zz + xx, -yz}, Vec{-zx, -yz, xx + yy}};
  solid.order.resize(mesh.triangles.size());
  std::iota(solid.order.begin(), solid.order.end(), 0);
  build(solid, 0, static_cast<int>(solid.order.size()));
  return solid;
}

}  // namespace independent

#include "ch01_convex_advancement/simplex.hpp"

#include <cmath>
#include <limits>

namespace fc::ca {
namespace {

using Points = std::array<Vec3, 4>;

void vertex(const Points& p, int i, SimplexPoint& s) {
  s.count = 1;
  s.index[0] = i;
  s.weight[0] = 1;
  s.point = p[i];
  s.direction = p[i];
}

void edge(const Points& p, int i, int j, SimplexPoint& s) {
  const Vec3 e = p[j] - p[i];
  const double to_j = -p[i].dot(e);  // both positive: the origin projects between i and j
  const double to_i = p[j].dot(e);
  if (!(to_j > 0)) return vertex(p, i, s);
  if (!(to_i > 0)) return vertex(p, j, s);
  s.count = 2;
  s.index[0] = i, s.index[1] = j;
  const double length2 = to_i + to_j;
  s.weight[0] = to_i / length2, s.weight[1] = to_j / length2;
  s.point = s.weight[0] * p[i] + s.weight[1] * p[j];
  s.direction = s.point - e * (e.dot(s.point) / length2);
}

void closer_edge(const Points& p, int i, int j, SimplexPoint& best) {
  SimplexPoint s;
  edge(p, i, j, s);
  if (s.point.squaredNorm() < best.point.squaredNorm()) best = s;
}

void triangle(const Points& p, int i, int j, int k, SimplexPoint& s) {
  const Vec3 normal = (p[j] - p[i]).cross(p[k] - p[i]);
  const double area2 = normal.squaredNorm();  // (twice the area) squared
  // Signed areas of the three parts that the origin's projection cuts, times the whole area.
  const double at_i = normal.dot(p[j].cross(p[k]));
  const double at_j = normal.dot(p[k].cross(p[i]));
  const double at_k = normal.dot(p[i].cross(p[j]));
  if (area2 > 0 && at_i > 0 && at_j > 0 && at_k > 0) {
    s.count = 3;
    s.index[0] = i, s.index[1] = j, s.index[2] = k;
    const double sum = at_i + at_j + at_k;
    s.weight[0] = at_i / sum, s.weight[1] = at_j / sum, s.weight[2] = at_k / sum;
    // Along the normal the origin's distance is that of any corner: the mean of the corners keeps the most
    // digits.
    const double along = normal.dot(p[i] + p[j] + p[k]);
    s.point = normal * (along / (3 * area2));
    s.direction = along < 0 ? Vec3(-normal) : normal;
    return;
  }
  // The closest point is on one of the edges beyond which the origin lies (if rounding leaves none, on any
  // edge).
  const bool near_jk = !(at_i > 0), near_ki = !(at_j > 0), near_ij = !(at_k > 0);
  s.point.setConstant(std::numeric_limits<double>::infinity());
  const bool none = !(near_jk || near_ki || near_ij) || !(area2 > 0);
  if (none || near_ij) closer_edge(p, i, j, s);
  if (none || near_jk) closer_edge(p, j, k, s);
  if (none || near_ki) closer_edge(p, i, k, s);
}

void tetrahedron(const Points& p, SimplexPoint& best) {
  const Vec3 p23 = p[2].cross(p[3]), p01 = p[0].cross(p[1]);
  // Signed volumes with the origin in place of one corner; their sum is the whole.
  const std::array<double, 4> part = {p[1].dot(p23), -p[0].dot(p23), p[3].dot(p01), -p[2].dot(p01)};
  const double volume = (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]));
  double scale = 0;
  for (const Vec3& x : p) scale = std::max(scale, x.squaredNorm());
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * scale * std::sqrt(scale);
  const bool flat = std::abs(volume) <= rounding;
  if (!flat) {
    bool inside = true;
    for (const double v : part) inside = inside && (volume > 0 ? v > 0 : v < 0);
    if (inside) {
      best.count = 4;
      best.index = {0, 1, 2, 3};
      for (int i = 0; i < 4; ++i) best.weight[i] = part[i] / volume;
      best.point.setZero();
      best.direction.setZero();
      return;
    }
  }
  static constexpr int face[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};  // face[i] lacks corner i
  double best_distance2 = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    // The origin lies beyond this face, or too near its plane to tell.
    const bool beyond = flat || part[i] * volume <= 0 || std::abs(part[i]) <= rounding;
    if (!beyond) continue;
    SimplexPoint candidate;
    triangle(p, face[i][0], face[i][1], face[i][2], candidate);
    const double distance2 = candidate.point.squaredNorm();
    if (distance2 < best_distance2) {
      best = candidate;
      best_distance2 = distance2;
    }
  }
}

}  // namespace

SimplexPoint closest_to_origin(const Points& points, int count) {
  SimplexPoint s;
  if (count == 1) vertex(points, 0, s);
  if (count == 2) edge(points, 0, 1, s);
  if (count == 3) triangle(points, 0, 1, 2, s);
  if (count == 4) tetrahedron(points, s);
  return s;
}

}  // namespace fc::ca

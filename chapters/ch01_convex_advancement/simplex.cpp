#include "ch01_convex_advancement/simplex.hpp"

#include <cmath>
#include <limits>

namespace fc::ca {
namespace {

using Points = std::array<Vec3, 4>;

SimplexPoint vertex(const Points& p, int i) {
  SimplexPoint s;
  s.count = 1;
  s.index[0] = i;
  s.weight[0] = 1;
  s.point = p[i];
  return s;
}

SimplexPoint edge(const Points& p, int i, int j) {
  const Vec3 e = p[j] - p[i];
  const double to_j = -p[i].dot(e);  // both positive: the origin projects between i and j
  const double to_i = p[j].dot(e);
  if (!(to_j > 0)) return vertex(p, i);
  if (!(to_i > 0)) return vertex(p, j);
  SimplexPoint s;
  s.count = 2;
  s.index = {i, j, 0, 0};
  const double length2 = to_i + to_j;
  s.weight = {to_i / length2, to_j / length2, 0, 0};
  s.point = s.weight[0] * p[i] + s.weight[1] * p[j];
  return s;
}

const SimplexPoint& closer(const SimplexPoint& a, const SimplexPoint& b) {
  return b.point.squaredNorm() < a.point.squaredNorm() ? b : a;
}

SimplexPoint triangle(const Points& p, int i, int j, int k) {
  const Vec3 normal = (p[j] - p[i]).cross(p[k] - p[i]);
  const double area2 = normal.squaredNorm();  // (twice the area) squared
  // Signed areas of the three parts that the origin's projection cuts, times the whole area.
  const double at_i = normal.dot(p[j].cross(p[k]));
  const double at_j = normal.dot(p[k].cross(p[i]));
  const double at_k = normal.dot(p[i].cross(p[j]));
  if (area2 > 0 && at_i > 0 && at_j > 0 && at_k > 0) {
    SimplexPoint s;
    s.count = 3;
    s.index = {i, j, k, 0};
    const double sum = at_i + at_j + at_k;
    s.weight = {at_i / sum, at_j / sum, at_k / sum, 0};
    // Along the normal the origin's distance is that of any corner: the mean of the corners keeps the most
    // digits.
    s.point = normal * (normal.dot(p[i] + p[j] + p[k]) / (3 * area2));
    return s;
  }
  SimplexPoint best = edge(p, i, j);
  best = closer(best, edge(p, j, k));
  return closer(best, edge(p, k, i));
}

SimplexPoint tetrahedron(const Points& p) {
  const double volume = (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]));
  // Signed volumes with the origin in place of one corner.
  const std::array<double, 4> part = {p[1].dot(p[2].cross(p[3])), -p[0].dot(p[2].cross(p[3])),
                                      p[0].dot(p[1].cross(p[3])), -p[0].dot(p[1].cross(p[2]))};
  double scale = 0;
  for (const Vec3& x : p) scale = std::max(scale, x.squaredNorm());
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * scale * std::sqrt(scale);
  const bool flat = std::abs(volume) <= rounding;
  if (!flat) {
    bool inside = true;
    for (const double v : part) inside = inside && (volume > 0 ? v > 0 : v < 0);
    if (inside) {
      SimplexPoint s;
      s.count = 4;
      s.index = {0, 1, 2, 3};
      for (int i = 0; i < 4; ++i) s.weight[i] = part[i] / volume;
      return s;  // point = 0
    }
  }
  static constexpr int face[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};  // face[i] lacks corner i
  SimplexPoint best;
  double best_distance2 = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    // The origin lies beyond this face, or too near its plane to tell.
    const bool beyond = flat || part[i] * volume <= 0 || std::abs(part[i]) <= rounding;
    if (!beyond) continue;
    const SimplexPoint candidate = triangle(p, face[i][0], face[i][1], face[i][2]);
    const double distance2 = candidate.point.squaredNorm();
    if (distance2 < best_distance2) {
      best = candidate;
      best_distance2 = distance2;
    }
  }
  return best;
}

}  // namespace

SimplexPoint closest_to_origin(const Points& points, int count) {
  switch (count) {
    case 1:
      return vertex(points, 0);
    case 2:
      return edge(points, 0, 1);
    case 3:
      return triangle(points, 0, 1, 2);
    default:
      return tetrahedron(points);
  }
}

}  // namespace fc::ca

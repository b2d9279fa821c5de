// Caught by: Ex02Billiard.ReflectsAtTheWallsNormal
// The part across the wall is taken away, not reversed.
#include "ex02_billiard.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

Bounce next_bounce(const Ellipse& wall, const Vec2& place, const Vec2& velocity) {
  // In units of the half axes the wall is the unit circle: |p + t u|^2 = 1.
  const Vec2 half(wall.a, wall.b);
  const Vec2 p = place.cwiseQuotient(half), u = velocity.cwiseQuotient(half);
  const double uu = u.squaredNorm(), pu = p.dot(u);
  const double inside = std::max(0.0, 1 - p.squaredNorm());  // >= 0; 0 on the wall
  const double root = std::sqrt(pu * pu + uu * inside);
  // The later root of uu t^2 + 2 pu t - inside = 0, without a difference of equals. On the wall the earlier
  // one is the start: it is not looked at.
  const double time = pu < 0 ? (root - pu) / uu : inside / (pu + root + (pu + root == 0 ? 1 : 0));
  const Vec2 q = p + time * u;
  return {time, q.normalized().cwiseProduct(half)};
}

Vec2 reflect(const Ellipse& wall, const Vec2& place, const Vec2& velocity) {
  const Vec2 normal = Vec2(place.x() / (wall.a * wall.a), place.y() / (wall.b * wall.b)).normalized();
  return velocity - normal.dot(velocity) * normal;
}

}  // namespace fc::exercises

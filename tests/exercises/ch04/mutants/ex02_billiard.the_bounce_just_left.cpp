// Caught by: Ex02Billiard.StraightAcross
// The earliest root that is not negative: on the wall that is the start.
#include "ex02_billiard.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

Bounce next_bounce(const Ellipse& wall, const Vec2& place, const Vec2& velocity) {
  // In units of the half axes the wall is the unit circle: |p + t u|^2 = 1.
  const Vec2 half(wall.a, wall.b);
  const Vec2 p = place.cwiseQuotient(half), u = velocity.cwiseQuotient(half);
  const double uu = u.squaredNorm(), pu = p.dot(u);
  const double inside = 1 - p.squaredNorm();
  const double root = std::sqrt(pu * pu + uu * std::max(0.0, inside));
  const double early = (-pu - root) / uu;
  const double time = early >= 0 ? early : (root - pu) / uu;
  const Vec2 q = p + time * u;
  return {time, q.normalized().cwiseProduct(half)};
}

Vec2 reflect(const Ellipse& wall, const Vec2& place, const Vec2& velocity) {
  const Vec2 normal = Vec2(place.x() / (wall.a * wall.a), place.y() / (wall.b * wall.b)).normalized();
  return velocity - 2 * normal.dot(velocity) * normal;
}

}  // namespace fc::exercises

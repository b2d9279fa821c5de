// Caught by: Ex02Billiard.HoweverSlowOrFast
// The square of a small speed is 0, and 0/0 is no time.
#include "ex02_billiard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::exercises {
namespace {

constexpr double kOnWall = 8 * std::numeric_limits<double>::epsilon();  // of x^2/a^2 + y^2/b^2: rounding

}  // namespace

Bounce next_bounce(const Ellipse& wall, const Vec2& place, const Vec2& velocity) {
  // In units of the half axes the wall is the unit circle: |p + t u|^2 = 1.
  // The time is counted in 1/fastest, or the square of a small velocity would be 0.
  const Vec2 half(wall.a, wall.b), per_second = velocity.cwiseQuotient(half);
  const double fastest = 1;
  const Vec2 p = place.cwiseQuotient(half), u = per_second / fastest;
  const double uu = u.squaredNorm(), pu = p.dot(u);
  const double inside = 1 - p.squaredNorm();
  // uu t^2 + 2 pu t - inside = 0. On the wall, where only rounding is left of `inside`, one root is the
  // start: divided out, it leaves a linear equation. (As a number, that rounding has a root of 1e-8: the
  // chords of grazing rays drown in it.) From inside it is the later root, without a difference of equals.
  double time = std::max(0.0, -2 * pu / uu);
  if (inside > kOnWall) {
    const double root = std::sqrt(pu * pu + uu * inside);
    time = pu < 0 ? (root - pu) / uu : inside / (root + pu);
  }
  const Vec2 q = p + time * u;
  return {time / fastest, q.normalized().cwiseProduct(half)};
}

Vec2 reflect(const Ellipse& wall, const Vec2& place, const Vec2& velocity) {
  const Vec2 normal = Vec2(place.x() / (wall.a * wall.a), place.y() / (wall.b * wall.b)).normalized();
  return velocity - 2 * normal.dot(velocity) * normal;
}

}  // namespace fc::exercises

// Caught by: Ex06StopPoints.TheDiamondTooLittle
// Friction stays at its first corner until that component is used up.
#include "ex02_stop_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace fc::exercises {

Vec2 stop_by_cone(const Vec2& v, double mu, double g) {
  return v.norm() / (2 * mu * g) * v;
}

Vec2 stop_by_box(const Vec2& v, double mu, double g) {
  return v.cwiseAbs().cwiseProduct(v) / (2 * mu * g);  // the axes know nothing of each other
}

// Friction is at the corner that is nearest to -v, until another corner is as near; from then on it is at the middle of the
// edge between both, which is straight against v.
Vec2 stop_by_pyramid(const Vec2& v, double mu, double g, int corners) {
  if (corners < 4 || corners % 2 != 0)
    throw std::invalid_argument("stop_by_pyramid: corners must be even and at least 4");
  if (v.isZero(0)) return Vec2::Zero();
  const double half = std::numbers::pi / corners;  // between a corner and the middle of an edge
  const double corner = 2 * half * std::round(std::atan2(v[1], v[0]) / (2 * half));
  const Vec2 along(std::cos(corner), std::sin(corner));
  Vec2 across(-along[1], along[0]);
  if (across.dot(v) < 0) across = -across;

  const double fast = v.dot(along), side = v.dot(across);
  const double slow = 0 * std::min(fast, side / std::tan(half));  // of `along`, when both corners are as near
  const double time = (fast - slow) / (mu * g);
  const Vec2 first = 0.5 * (fast + slow) * time * along + side * time * across;
  const Vec2 left = slow * along + side * across;
  return first + left.norm() / (2 * mu * g * std::cos(half)) * left;
}

Error error_of(const Vec2& way, const Vec2& v, double mu, double g) {
  const Vec2 truth = stop_by_cone(v, mu, g);
  return {std::atan2(v[0] * way[1] - v[1] * way[0], v.dot(way)), way.norm() / truth.norm()};
}

int corners_for(double angle) {
  // At most half of the angle between two corners.
  const double corners = std::numbers::pi / angle;
  return std::max(4, 2 * static_cast<int>(std::ceil(0.5 * corners * (1 - 1e-12))));
}

}  // namespace fc::exercises

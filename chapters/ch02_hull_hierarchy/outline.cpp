#include "ch02_hull_hierarchy/outline.hpp"

#include <cmath>
#include <numbers>

namespace fc::hulls {
namespace {

constexpr double kNearlyFlat = 0.1;   // sine of an angle
constexpr double kStraightOn = 1e-9;  // sine of an angle: a direction nearer to the axis faces no side

void add_rim(Outline& outline, const Vec3& middle, double radius, const Vec3& lowest, const Vec3& normal) {
  const Vec3 next = normal.cross(lowest);
  for (int k = 0; k < Outline::kRim; ++k) {
    const double angle = 2 * std::numbers::pi * k / Outline::kRim;
    outline.corners[static_cast<std::size_t>(outline.count++)] =
        middle + radius * (std::cos(angle) * lowest + std::sin(angle) * next);
  }
}

}  // namespace

Outline outline_of(const Model& curved, const Vec3& direction) {
  const Vec3 &low = curved.mesh.vertices[0], &high = curved.mesh.vertices[1], &axis = curved.axis;
  const std::array<double, 2> disk = {curved.disks[0], curved.disks[1]};
  const double along = direction.dot(axis);
  Vec3 sideways = direction - along * axis;
  const double across = sideways.norm();
  sideways = across > kStraightOn ? Vec3(sideways / across) : axis.unitOrthogonal();

  Outline outline;
  const int end = along > 0 ? 1 : 0;
  const Vec3 cap = end == 1 ? axis : Vec3(-axis);
  if (across <= kNearlyFlat && disk[static_cast<std::size_t>(end)] > 0) {
    outline.normal = cap;
    outline.kind = ca::FeatureKind::face;
    outline.id = end;
    add_rim(outline, end == 1 ? high : low, disk[static_cast<std::size_t>(end)], sideways, cap);
    return outline;
  }
  const Vec3 at_low = low + disk[0] * sideways, at_high = high + disk[1] * sideways;
  const Vec3 line = (at_high - at_low).normalized();
  if (std::abs(line.dot(direction)) <= kNearlyFlat) {
    outline.normal = (sideways - sideways.dot(line) * line).normalized();
    outline.kind = ca::FeatureKind::face;
    outline.id = 2;
    outline.count = 2;
    outline.corners[0] = at_low;
    outline.corners[1] = at_high;
    return outline;
  }
  const bool upper = direction.dot(at_high) > direction.dot(at_low);
  outline.corners[0] = upper ? at_high : at_low;
  outline.count = 1;
  outline.normal = direction;
  outline.id = upper ? 1 : 0;
  outline.kind =
      disk[static_cast<std::size_t>(outline.id)] > 0 ? ca::FeatureKind::edge : ca::FeatureKind::vertex;
  return outline;
}

}  // namespace fc::hulls

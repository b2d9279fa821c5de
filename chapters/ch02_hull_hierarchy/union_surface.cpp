#include "ch02_hull_hierarchy/union_surface.hpp"

namespace fc::hulls {
namespace {

constexpr double kOn = 1e-9;     // of the compound's reach: a point this near to a part is on it
constexpr double kLeads = 1e-9;  // of the compound's reach: a part must reach this much farther along n

bool is_on(const Model& part, const Vec3& point, double near) {
  const ca::Convex alone{std::span(&point, 1), 0, point.norm(), point};
  const Pose origin{Mat3::Identity(), Vec3::Zero()};
  return ca::distance(part.leaf(0), alone, ca::PairPose(origin, origin), {0.1 * near, 1e-6, 128}).upper <=
         near;
}

}  // namespace

bool shows(const Model& compound, int part, const Vec3& point, const Vec3& outward) {
  for (int other = 0; other < static_cast<int>(compound.parts.size()); ++other) {
    if (other == part) continue;
    const Model& model = compound.parts[static_cast<std::size_t>(other)];
    const double top = ca::support(model.leaf(0), outward).point.dot(outward) + model.radius;
    const bool leads = top - point.dot(outward) > kLeads * compound.reach;
    if (leads && is_on(model, point, kOn * compound.reach)) return false;
  }
  return true;
}

}  // namespace fc::hulls

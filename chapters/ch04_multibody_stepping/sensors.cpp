#include "ch04_multibody_stepping/sensors.hpp"

#include <algorithm>

#include "ch02_hull_hierarchy/inside.hpp"

namespace fc::world {

std::optional<Sighting> look(World& world, int a, int b, double now, bool& touching) {
  const ca::Motion motion_a = world.motion(a, now), motion_b = world.motion(b, now);
  const ca::PairPose pose(motion_a, motion_b, 0);
  const hulls::Model &model_a = world.model_of(a), &model_b = world.model_of(b);
  const hulls::ModelDistance distance = hulls::model_distance(model_a, model_b, pose, world.tolerance);
  const ca::GjkResult& nearest = distance.nearest.gjk;
  touching =
      distance.lower <= world.tolerance || hulls::one_inside_other(model_a, model_b, pose, world.tolerance);

  const std::pair<int, int> names(a, b);
  const auto known = std::lower_bound(world.sighted.begin(), world.sighted.end(), names);
  const bool was_touching = known != world.sighted.end() && *known == names;
  if (touching == was_touching) return {};
  if (!touching) {
    world.sighted.erase(known);
    return {};
  }
  world.sighted.insert(known, names);

  const double sign = world.bodies[a].sensor ? 1 : -1;
  Sighting sighting{now, sign > 0 ? a : b, sign > 0 ? b : a};
  sighting.normal = sign * nearest.normal;
  sighting.gap = distance.lower;
  const Vec3 from_a = 0.5 * (nearest.point_a + nearest.point_b);
  sighting.point = motion_a.position + from_a;
  const Vec3 from_b = sighting.point - motion_b.position;
  sighting.speed = nearest.normal.dot((motion_b.velocity + motion_b.spin.cross(from_b)) -
                                      (motion_a.velocity + motion_a.spin.cross(from_a)));
  return sighting;
}

}  // namespace fc::world

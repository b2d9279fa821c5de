#include "ch05_resting_contact/kinematic_watch.hpp"

#include <algorithm>
#include <optional>

#include "ch04_multibody_stepping/sensors.hpp"
#include "ch05_resting_contact/path.hpp"

namespace fc::resting {
namespace {

// The time (s) at which the two meet; nothing if they keep apart.
std::optional<double> clash(const world::World& world, Contacts& contacts, int a, int b, double dt) {
  PairContacts& pair = contacts.pair(a, b);
  const Path path_a = path_of(world, pair.a, 0, dt), path_b = path_of(world, pair.b, 0, dt);
  const double distance = dt * ((path_b.velocity - path_a.velocity).norm() +
                                0.5 * dt * (path_b.acceleration - path_a.acceleration).norm());
  if ((path_b.start.position - path_a.start.position).norm() > path_a.reach + path_b.reach + distance)
    return {};
  contacts.update(world, pair, path_a.start, path_b.start);
  if (pair.gap > world.tolerance) {
    const PathVerdict verdict =
        check_path(world, contacts, pair, path_a, path_b, dt, {.required_gap = 0.5 * world.tolerance});
    if (verdict.clear) return {};
    return verdict.time;
  }
  if (!Contacts::convex(world, pair) || !pair.axis_known) return {};
  const double end = contacts.axis_gap(world, pair, path_a.end, path_b.end);
  if (end > std::min(0.0, pair.gap) - world.tolerance) return {};
  return 0.0;
}

}  // namespace

std::vector<Clash> KinematicWatch::look(const world::World& world, Contacts& contacts, double dt) {
  std::vector<Clash> clashes;
  const int count = static_cast<int>(world.bodies.size());
  for (int a = 0; a < count; ++a) {
    if (!world.is_moving_kinematic(a)) continue;
    for (int b = 0; b < count; ++b) {
      if (b == a || world.is_dynamic(b) || (world.is_moving_kinematic(b) && b < a)) continue;
      if (world::is_sensor_pair(world, a, b) || reported_.contains({a, b})) continue;
      const std::optional<double> time = clash(world, contacts, a, b, dt);
      if (!time) continue;
      reported_.insert({a, b});
      clashes.push_back({a, b, *time});
    }
  }
  return clashes;
}

}  // namespace fc::resting

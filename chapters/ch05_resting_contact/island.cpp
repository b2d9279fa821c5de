#include "ch05_resting_contact/island.hpp"

#include <algorithm>

#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::resting {

IslandFinder::IslandFinder(Contacts& contacts, std::size_t bodies)
    : contacts_(contacts), stamp_(bodies, 0), place_(bodies, -1) {}

void IslandFinder::begin(double now) {
  now_ = now;
  ++now_stamp_;
}

int IslandFinder::place_of(const world::World& world, Island& island, int body) {
  int& place = place_[static_cast<std::size_t>(body)];
  const bool dynamic = world.yields(body);
  const bool known = dynamic ? is_in_island(body) : place >= 0;
  if (known) return place;
  place = static_cast<int>(island.members.size());
  if (dynamic) stamp_[static_cast<std::size_t>(body)] = now_stamp_;
  RigidBody state = world.state_at(body, now_);
  if (world.bodies[static_cast<std::size_t>(body)].held) state.velocity = state.spin = Vec3::Zero();
  island.members.push_back({body, state, dynamic});
  return place;
}

Island IslandFinder::grow(const world::World& world, int body) {
  Island island;
  place_of(world, island, body);
  std::vector<int> others;
  for (std::size_t next = 0; next < island.members.size(); ++next) {
    if (!island.members[next].dynamic) continue;
    const int i = island.members[next].number;
    const Pose pose = island.members[next].state.pose();
    const world::Body& b = world.bodies[static_cast<std::size_t>(i)];
    const Vec3 half = (pose.rotation.cwiseAbs() * world.half_extents[static_cast<std::size_t>(b.shape)])
                          .cwiseMin(Vec3::Constant(world.shapes[static_cast<std::size_t>(b.shape)].reach)) +
                      Vec3::Constant(contacts_.margin());
    others.clear();
    world.schedule.overlapping({pose.position - half, pose.position + half}, [&](int other) {
      if (other == i || world::is_sensor_pair(world, i, other)) return;
      // Of two that can be moved, whoever was looked at first has looked at both.
      if (world.yields(other) && is_in_island(other) &&
          place_[static_cast<std::size_t>(other)] < static_cast<int>(next))
        return;
      others.push_back(other);
    });
    std::sort(others.begin(), others.end());
    for (const int other : others) {
      PairContacts& pair = contacts_.pair(i, other);
      const Pose there = world.state_at(other, now_).pose();
      contacts_.update(world, pair, pair.a == i ? pose : there, pair.a == i ? there : pose);
      if (pair.points.empty() || pair.gap > contacts_.margin()) continue;
      const int place = place_of(world, island, other), own = static_cast<int>(next);
      island.pairs.push_back({&pair, pair.a == i ? own : place, pair.a == i ? place : own});
    }
  }
  for (const Member& member : island.members) {
    if (member.dynamic)
      ++island.dynamic;
    else
      place_[static_cast<std::size_t>(member.number)] = -1;
  }
  return island;
}

}  // namespace fc::resting

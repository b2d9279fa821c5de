#include "ch05_resting_contact/island.hpp"

#include <algorithm>

#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::resting {

IslandFinder::IslandFinder(Contacts& contacts, std::size_t bodies)
    : contacts_(contacts), stamp_(bodies, 0), place_(bodies, -1) {}

void IslandFinder::begin(double now) {
  now_ = now;
  first_ = island_ + 1;
}

int IslandFinder::place_of(const world::World& world, Island& island, int body) {
  int& place = place_[static_cast<std::size_t>(body)];
  const bool dynamic = world.yields(body);
  const bool known = dynamic ? stamp_[static_cast<std::size_t>(body)] == island_ : place >= 0;
  if (known) return place;
  place = static_cast<int>(island.members.size());
  if (dynamic) stamp_[static_cast<std::size_t>(body)] = island_;
  RigidBody state = world.state_at(body, now_);
  if (world.bodies[static_cast<std::size_t>(body)].held) state.velocity = state.spin = Vec3::Zero();
  island.members.push_back({body, state, dynamic});
  return place;
}

Island IslandFinder::grow(const world::World& world, int body, std::vector<char>& crowded, double left) {
  const double fall = world.effects.gravity ? left * world.effects.gravity->norm() : 0;  // m/s
  const auto speed = [&](int number, const RigidBody& state) {
    return state.velocity.norm() +
           state.spin.norm() * world.shapes[static_cast<std::size_t>(world.bodies[static_cast<std::size_t>(number)].shape)].reach;
  };
  Island island;
  ++island_;
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
    const double own_speed = speed(i, island.members[next].state);
    const Vec3 path = Vec3::Constant(crowded[static_cast<std::size_t>(i)] ? left * (own_speed + fall) : 0.0);
    others.clear();
    world.schedule.overlapping({pose.position - half - path, pose.position + half + path}, [&](int other) {
      if (other == i || world::is_sensor_pair(world, i, other)) return;
      // Of two that can be moved, whoever was looked at first has looked at both.
      // One that is in another island was not reached from there: a crowd reaches farther than it does.
      if (world.yields(other) && is_in_island(other) &&
          (stamp_[static_cast<std::size_t>(other)] != island_ ||
           place_[static_cast<std::size_t>(other)] < static_cast<int>(next)))
        return;
      others.push_back(other);
    });
    std::sort(others.begin(), others.end());
    for (const int other : others) {
      PairContacts& pair = contacts_.pair(i, other);
      const RigidBody state = world.state_at(other, now_);
      const Pose there = state.pose();
      contacts_.update(world, pair, pair.a == i ? pose : there, pair.a == i ? there : pose);
      if (pair.points.empty() || pair.gap > contacts_.margin()) {
        const bool arrives = crowded[static_cast<std::size_t>(i)] && world.yields(other) &&
                             pair.gap - left * (own_speed + speed(other, state) + fall) <= contacts_.margin();
        if (!arrives) continue;
        crowded[static_cast<std::size_t>(other)] = 1;
      }
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

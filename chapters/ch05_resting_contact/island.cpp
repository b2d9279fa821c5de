#include "ch05_resting_contact/island.hpp"

#include <algorithm>
#include <numeric>

#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::resting {

lcp::Contact contact_at(const world::World& world, std::span<const Member> members,
                        std::span<const RigidBody> bodies, int a, int b, const ContactPoint& point) {
  const Pose pose_a = bodies[at(a)].pose(), pose_b = bodies[at(b)].pose();
  const double gap = point.gap_at(pose_a, pose_b);
  return {a,   b, point.middle(pose_a, pose_b),       point.normal_at(pose_a, pose_b),
          gap, 0, world.turns(members[at(a)].number), world.turns(members[at(b)].number)};
}

IslandFinder::IslandFinder(Contacts& contacts, std::size_t bodies)
    : contacts_(contacts), stamp_(bodies, 0), place_(bodies, -1) {}

void IslandFinder::begin(double now) {
  now_ = now;
  first_ = island_ + 1;
}

int IslandFinder::place_of(const world::World& world, Island& island, int body) {
  int& place = place_[at(body)];
  const bool dynamic = world.is_dynamic(body);
  const bool known = dynamic ? stamp_[at(body)] == island_ : place >= 0;
  if (known) return place;
  place = static_cast<int>(island.members.size());
  if (dynamic) stamp_[at(body)] = island_;
  RigidBody state = world.state_at(body, now_);
  if (world.bodies[at(body)].frozen) state.velocity = state.spin = Vec3::Zero();
  island.members.push_back({body, state, dynamic});
  return place;
}

Island IslandFinder::grow(const world::World& world, int body, const std::vector<int>& pile_of) {
  Island island;
  ++island_;
  place_of(world, island, body);
  for (std::size_t next = 0; next < island.members.size(); ++next) {
    const int i = island.members[next].number;
    if (!island.members[next].dynamic || pile_of[at(i)] >= 0) continue;
    const Pose pose = island.members[next].state.pose();
    const auto shape = at(world.bodies[at(i)].shape);
    const Vec3 half = (pose.rotation.cwiseAbs() * world.half_extents[shape])
                          .cwiseMin(Vec3::Constant(world.shapes[shape].reach)) +
                      Vec3::Constant(contacts_.margin());
    others_.clear();
    world.schedule.overlapping({pose.position - half, pose.position + half}, [&](int other) {
      if (other == i || world::is_sensor_pair(world, i, other)) return;
      // Of two that can be moved, the one that was visited first has handled the pair.
      const auto k = at(other);
      const bool done = stamp_[k] == island_ && place_[k] < static_cast<int>(next) && pile_of[k] < 0;
      if (!world.is_dynamic(other) || !done) others_.push_back(other);
    });
    std::sort(others_.begin(), others_.end());
    for (const int other : others_) {
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
      place_[at(member.number)] = -1;
  }
  return island;
}

std::vector<std::vector<int>> find_piles(const world::World& world, Contacts& contacts, double dt,
                                         double most_work,
                                         const std::function<double(double, int)>& event_work,
                                         const std::vector<std::vector<int>>& known) {
  const std::size_t count = world.bodies.size();
  std::vector<int> parent(count), arrivals(count, 0), points(count, 0);
  std::vector<char> piled(
      count, event_work(0, 0) > most_work);  // of each root: its group is a pile, whatever else it contains
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int body) {
    while (parent[at(body)] != body) body = parent[at(body)] = parent[at(parent[at(body)])];
    return body;
  };
  for (const std::vector<int>& pile : known) {  // in order
    for (const int body : pile) parent[at(body)] = pile.front();
    piled[at(pile.front())] = 1;
  }
  world.schedule.overlapping_pairs([&](int a, int b) {
    if (!world.is_dynamic(a) || !world.is_dynamic(b) || world.bodies[at(a)].sensor ||
        world.bodies[at(b)].sensor)
      return;
    if (root(a) == root(b) && piled[at(root(a))]) return;
    PairContacts& pair = contacts.pair(a, b);
    const RigidBody &first = world.bodies[at(pair.a)].state, &second = world.bodies[at(pair.b)].state;
    const double gap = contacts.least_gap(world, pair, first.pose(), second.pose());
    const double distance =
        dt * ((second.velocity - first.velocity).norm() + first.spin.norm() * world.model_of(pair.a).reach +
              second.spin.norm() * world.model_of(pair.b).reach);
    if (gap - distance > contacts.margin()) return;
    const int low = std::min(root(a), root(b)), high = std::max(root(a), root(b));
    parent[at(high)] = low;
    piled[at(low)] = piled[at(low)] || piled[at(high)];
    if (high != low) {
      arrivals[at(low)] += arrivals[at(high)];
      points[at(low)] += points[at(high)];
    }
    if (!pair.known && Contacts::convex(world, pair))
      contacts.update(world, pair, first.pose(), second.pose());
    const int rank = pair.rank();
    if (rank == 0 || pair.gap > contacts.margin())
      ++arrivals[at(low)];
    else
      points[at(low)] += rank;
    piled[at(low)] = piled[at(low)] || event_work(arrivals[at(low)], points[at(low)]) > most_work;
  });
  std::vector<std::vector<int>> piles;
  std::vector<int> pile_of(count, -1);
  for (int body = 0; body < static_cast<int>(count); ++body) {
    const auto first = at(root(body));
    if (!piled[first]) continue;
    if (pile_of[first] < 0) {
      pile_of[first] = static_cast<int>(piles.size());
      piles.emplace_back();
    }
    piles[at(pile_of[first])].push_back(body);
  }
  return piles;
}

}  // namespace fc::resting

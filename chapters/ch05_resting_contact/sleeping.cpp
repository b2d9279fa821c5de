#include "ch05_resting_contact/sleeping.hpp"

#include "ch05_resting_contact/standing.hpp"

namespace fc::resting {
namespace {

// Whether the island may sleep. Counts for how long its bodies have been slow.
bool rests(world::World& world, const Island& island, double dt) {
  bool lies = false, all = true;
  for (const Member& member : island.members) {
    world::Body& body = world.bodies[at(member.number)];
    if (!member.dynamic) {
      lies = true;
      all = all && !world.is_moving_kinematic(member.number);
      continue;
    }
    const double speed = fastest_point(world, member.number, body.state.velocity, body.state.spin);
    body.still = speed <= world.effects.sleep->speed ? body.still + dt : 0;
    all = all && body.still >= world.effects.sleep->after;
  }
  return lies && all;
}

}  // namespace

void wake(world::World& world, std::span<const Member> members, world::StepReport& report) {
  for (const Member& member : members) {
    world::Body& body = world.bodies[at(member.number)];
    if (!member.dynamic || !body.asleep) continue;
    body.asleep = false;
    body.still = 0;
    ++report.wakes;
  }
}

void fall_asleep(world::World& world, IslandFinder& islands, double dt, world::StepReport& report) {
  const std::vector<int> no_piles(world.bodies.size(), -1);
  islands.begin(0);
  for (int i = 0; i < static_cast<int>(world.bodies.size()); ++i) {
    if (!world.is_dynamic(i) || world.bodies[at(i)].asleep || islands.is_in_island(i)) continue;
    const Island island = islands.grow(world, i, no_piles);
    if (!rests(world, island, dt)) continue;
    for (const Member& member : island.members) {
      if (!member.dynamic) continue;
      world::Body& body = world.bodies[at(member.number)];
      report.slept_energy += body.state.kinetic_energy();
      ++report.falls_asleep;
      body.state.velocity = body.state.spin = Vec3::Zero();
      body.free.reset();
      body.asleep = true;
    }
  }
}

}  // namespace fc::resting

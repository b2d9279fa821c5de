// Of a frame: islands that fall asleep, and wake when something touches them.
#include <algorithm>

#include "ch05_resting_contact/resting.hpp"

namespace fc::resting {

// Bodies that contacts join sleep together, or not at all.
Joined Resting::joined_by_contacts(const world::World& world) const {
  Joined joined(world.bodies.size());
  for (const ShellContact& shell : shell_.contacts())
    if (world.yields(shell.contact.body_a) && world.yields(shell.contact.body_b))
      joined.join(shell.contact.body_a, shell.contact.body_b);
  return joined;
}

// Who may be touched in this part of the frame, by somebody awake or driven, wakes; and everybody joined to
// it.
void Resting::wake_touched(world::World& world, RestReport& report) {
  if (!world.effects.sleep) return;
  Joined joined = joined_by_contacts(world);
  std::vector<char> touched(world.bodies.size(), 0);
  for (const ShellPair& pair : shell_.pairs()) {
    const bool a_sleeps = world.bodies[pair.a].asleep, b_sleeps = world.bodies[pair.b].asleep;
    const int other = a_sleeps ? pair.b : pair.a;
    if (a_sleeps == b_sleeps || world.stays(other)) continue;
    const Sweep& sweep = sweeps_[at(other)];
    const double way = (sweep.end - given_[at(other)].position).norm() +
                       sweep.turn * world.shapes[world.bodies[other].shape].reach + sweep.sag;
    if (pair.gap - way <= shell_.envelope()) touched[at(joined.root(a_sleeps ? pair.a : pair.b))] = 1;
  }
  for (int body = 0; body < static_cast<int>(touched.size()); ++body) {
    if (!world.bodies[body].asleep || !touched[at(joined.root(body))]) continue;
    world.bodies[body].asleep = false;
    still_[at(body)] = 0;
    ++report.step.wakes;
  }
}

// At a frame's end: an island whose bodies have all been carried, and slow, for long enough.
void Resting::fall_asleep(world::World& world, RestReport& report) {
  if (!world.effects.sleep) return;
  const SleepSpec& sleep = *world.effects.sleep;
  Joined joined = joined_by_contacts(world);
  std::vector<char> restless(world.bodies.size(), 0);
  for (int number = 0; number < static_cast<int>(restless.size()); ++number) {
    const world::Body& body = world.bodies[number];
    if (!world.yields(number) || body.asleep) continue;
    const double speed = body.state.velocity.norm() + world.shapes[body.shape].reach * body.state.spin.norm();
    double& still = still_[at(number)];
    still = body.supported && speed <= sleep.speed ? still + frame_ : 0;
    if (still < sleep.after) restless[at(joined.root(number))] = 1;
  }
  for (const ShellContact& shell : shell_.contacts()) {
    const lcp::Contact& c = shell.contact;
    if (world.carries(c.body_a)) restless[at(joined.root(c.body_b))] = 1;
    if (world.carries(c.body_b)) restless[at(joined.root(c.body_a))] = 1;
  }
  for (int number = 0; number < static_cast<int>(restless.size()); ++number) {
    world::Body& body = world.bodies[number];
    if (!world.yields(number) || body.asleep || restless[at(joined.root(number))]) continue;
    report.step.slept_energy += body.state.kinetic_energy();
    ++report.step.falls_asleep;
    body.state.velocity = body.state.spin = Vec3::Zero();
    body.free.reset();
    body.asleep = true;
  }
}

}  // namespace fc::resting

#include "ch05_resting_contact/resting.hpp"

#include <algorithm>

#include "ch05_resting_contact/islands.hpp"
#include "ch05_resting_contact/steering.hpp"
#include "common/stopwatch.hpp"

namespace fc::resting {
namespace {

// A contact with a gap of less than so many tolerances has no way left.
constexpr double kNoWay = 2;

// A body in contact whose points are slower than this part of the envelope in a frame stands still: below it
// is round-off of impulses that cancel.
constexpr double kStill = 1e-9;

}  // namespace

Resting::Resting(const Scene& scene, world::World& world, double dt)
    : shell_(envelope_of(scene, world)), dt_(dt) {
  world.rest_speed = shell_.envelope() / dt;
  world.touch = shell_.envelope();
}

// ANCHOR: step
RestReport Resting::step(world::World& world, const world::Listeners& listeners) {
  const Stopwatch watch;
  RestReport report;
  for (world::Body& body : world.bodies) body.supported = false;
  shell_.find(world);
  solve_islands(world, listeners, report);          // contacts that last
  add(world::step(world, dt_, listeners), report);  // chapter 4: everything else
  report.steering = steer(world, shell_, solver_);  // gaps
  report.step.step_ns = watch.ns();
  report.step.ccd_ns = report.step.step_ns - report.step.lcp_ns;
  return report;
}
// ANCHOR_END: step

// The frame's report is that of chapter 4's step, and what the islands added to it.
void Resting::add(const world::StepReport& events, RestReport& report) const {
  const world::StepReport resting = report.step;
  report.step = events;
  report.step.contacts += resting.contacts;
  report.step.impacts += resting.impacts;
  report.step.lcp_rows += resting.lcp_rows;
  report.step.solves += resting.solves;
  report.step.lcp_ns += resting.lcp_ns;
  report.step.lcp_residual = std::max(events.lcp_residual, resting.lcp_residual);
  report.step.min_gap = std::min(events.min_gap, report.smallest_gap);
  report.step.max_penetration = std::max(events.max_penetration, -std::min(0.0, report.smallest_gap));
}

void Resting::solve_islands(world::World& world, const world::Listeners& listeners, RestReport& report) {
  std::vector<ShellContact>& shell = shell_.contacts();
  const double fast = shell_.envelope() / dt_;
  report.searched = shell_.searched();
  report.shell_contacts = static_cast<int>(shell.size());
  report.smallest_gap = shell_.smallest_gap();

  std::vector<RigidBody> states;
  for (const world::Body& body : world.bodies) states.push_back(body.state);
  std::vector<char> taken(shell.size());
  for (std::size_t i = 0; i < shell.size(); ++i) {
    // What comes in faster than the shell allows is an impact, and chapter 4's. (Unless it has no way left to
    // come in: then it is stopped here, without a bounce.)
    taken[i] = -lcp::contact_velocity(states, shell[i].contact) <= fast ||
               shell[i].contact.gap < kNoWay * world.tolerance;
    if (!taken[i]) shell[i].impulse = 0;
  }
  std::vector<int> place(world.bodies.size(), -1);
  for (const std::vector<int>& members : islands_of(world, shell, taken)) {
    Island island(world, shell, members, place);
    solve(world, members, island, listeners, report);
  }
  if (listeners.instant && report.step.impacts > 0) listeners.instant(world, 0);
}

void Resting::solve(world::World& world, const std::vector<int>& members, Island& island,
                    const world::Listeners& listeners, RestReport& report) {
  const Stopwatch watch;
  std::vector<ShellContact>& shell = shell_.contacts();
  const double middle = 0.5 * shell_.envelope();
  // The velocities that gravity would make of them by the frame's end. (One that was held did not live
  // through the last frame: it has that frame's gravity already.)
  if (world.effects.gravity)
    for (std::size_t k = 0; k < island.bodies.size(); ++k)
      if (!island.bodies[k].is_static() && !world.bodies[island.numbers[k]].was_held)
        island.bodies[k].velocity += dt_ * *world.effects.gravity;
  std::vector<double> allowed, impulses, before;
  for (std::size_t k = 0; k < members.size(); ++k) {
    allowed.push_back(std::max(0.0, island.contacts[k].gap - middle) / dt_);
    impulses.push_back(shell[members[k]].impulse);
    before.push_back(lcp::contact_velocity(island.bodies, island.contacts[k]));
  }
  const IslandResult result = solver_.solve(island.bodies, island.contacts, allowed, impulses, {});
  FC_CHECK(result.solved, "the resting contacts of an island could not be solved");
  const int rows = static_cast<int>(members.size());
  report.sweeps += result.sweeps;
  report.largest_island = std::max(report.largest_island, rows);
  report.step.contacts += rows;
  report.step.lcp_rows += rows;
  ++report.step.solves;
  report.step.lcp_residual = std::max(report.step.lcp_residual, result.residual);

  const Vec3 gravity = world.effects.gravity.value_or(Vec3(Vec3::Zero()));
  std::vector<char> pushed(island.bodies.size()), supported(island.bodies.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    const lcp::Contact& contact = island.contacts[k];
    shell[members[k]].impulse = impulses[k];
    if (!(impulses[k] > 0)) continue;
    pushed[contact.body_a] = pushed[contact.body_b] = 1;
    if (world::bears_weight(contact.normal, gravity))
      supported[contact.body_a] = supported[contact.body_b] = 1;
    ++report.step.impacts;
    if (listeners.impact)
      listeners.impact({0,
                        shell[members[k]].contact,
                        {0, 0, before[k], lcp::contact_velocity(island.bodies, contact), impulses[k]}});
  }
  for (std::size_t k = 0; k < island.bodies.size(); ++k) {
    RigidBody& state = island.bodies[k];
    if (!pushed[k] || state.is_static()) continue;  // nothing pushed it: it falls, in closed form
    if (supported[k] &&
        (state.velocity.norm() + island.reaches[k] * state.spin.norm()) * dt_ < kStill * shell_.envelope())
      state.velocity = state.spin = Vec3::Zero();
    // Pushed by walls alone it goes on falling, in closed form: gravity will add again what is in its
    // velocity.
    world.bodies[island.numbers[k]].supported = supported[k];
    if (!supported[k] && !world.bodies[island.numbers[k]].was_held) state.velocity -= dt_ * gravity;
    world.set_course(island.numbers[k], state, 0);
  }
  report.step.lcp_ns += watch.ns();
}

}  // namespace fc::resting

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ch04_multibody_stepping/contact_search.hpp"
#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t ns_since(Clock::time_point start) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
}

struct Totals {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double linear_size = 0, angular_size = 0, kinetic = 0;

  Totals(const std::vector<RigidBody>& bodies, const std::vector<int>& members) {
    for (const int i : members) {
      const RigidBody& body = bodies[i];
      const Vec3 own = body.inertia_world() * body.spin, orbit = body.position.cross(body.momentum());
      linear += body.momentum();
      angular += orbit + own;
      linear_size += body.momentum().norm();
      angular_size += orbit.norm() + own.norm();
      kinetic += body.kinetic_energy();
    }
  }
};

// Solves everything that touches in the island, and starts the bodies anew from `now`.
void solve_island(World& world, const Island& island, double now, StepReport& report,
                  const OnImpact& on_impact) {
  const Clock::time_point start = Clock::now();
  std::vector<RigidBody> states(world.bodies.size());
  for (const lcp::Contact& contact : island.contacts)
    for (const int body : {contact.body_a, contact.body_b}) states[body] = world.state_at(body, now);
  for (const int body : island.bodies) states[body] = world.state_at(body, now);
  const Totals before(states, island.bodies);
  const lcp::ImpactResult impact = lcp::resolve_impact(states, island.contacts, world.impact);
  FC_CHECK(impact.status == lcp::Status::solved,
           std::string("the contacts of an instant could not be solved: ") + lcp::name(impact.status));
  const Totals after(states, island.bodies);
  report.contacts += static_cast<int>(island.contacts.size()) * impact.solves;
  report.impacts += static_cast<int>(impact.impulses.size());
  report.lcp_rows += impact.rows;
  report.solves += impact.solves;
  report.lcp_residual = std::max(report.lcp_residual, impact.worst_residual);
  report.energy_gain = std::max(report.energy_gain, after.kinetic - before.kinetic);
  report.energy_error =
      std::max(report.energy_error, std::abs(after.kinetic - before.kinetic - impact.energy_identity));
  const bool free = std::none_of(island.contacts.begin(), island.contacts.end(), [&](const lcp::Contact& c) {
    return states[c.body_a].is_static() || states[c.body_b].is_static();
  });
  if (free && before.linear_size > 0)
    report.momentum_error =
        std::max({report.momentum_error, (after.linear - before.linear).norm() / before.linear_size,
                  (after.angular - before.angular).norm() / before.angular_size});
  if (!impact.impulses.empty())
    for (const int body : island.bodies) {
      const bool same = world.bodies[body].held &&
                        states[body].velocity == world.bodies[body].state.velocity &&
                        states[body].spin == world.bodies[body].state.spin;
      if (same) continue;  // a held body that was not hit stays held
      if (world.bodies[body].held)
        report.lost_time = std::max(report.lost_time, now - world.bodies[body].time);
      world.bodies[body] = {states[body], now, world.bodies[body].shape, false};
      for (const int p : world.pairs_of[body]) world.pairs[p].known = false;
    }
  if (on_impact)
    for (const lcp::Impulse& impulse : impact.impulses)
      on_impact({now, island.contacts[impulse.contact], impulse});
  report.lcp_ns += ns_since(start);
}

void hold(World& world, const Island& island, double now) {
  for (const int body : island.bodies) {
    if (world.bodies[body].held) continue;
    world.bodies[body] = {world.state_at(body, now), now, world.bodies[body].shape, true};
    for (const int p : world.pairs_of[body]) world.pairs[p].known = false;
  }
}

void find_all_next_contacts(World& world, double now, double dt, StepReport& report) {
  for (Pair& pair : world.pairs)
    if (!pair.known) find_next_contact(world, pair, now, dt, report);
}

}  // namespace

StepReport step(World& world, double dt, const OnImpact& on_impact, const OnInstant& on_instant) {
  if (!(dt > 0 && std::isfinite(dt)))
    throw std::invalid_argument(fmt::format("step: dt is {} s; it must be finite and > 0", dt));
  const Clock::time_point start = Clock::now();
  StepReport report;
  report.min_gap = std::numeric_limits<double>::infinity();
  for (Pair& pair : world.pairs) pair.known = false;

  // ANCHOR: step
  double now = 0;
  while (true) {
    // From contact to contact: the earliest of all pairs.
    find_all_next_contacts(world, now, dt, report);
    const auto next = std::min_element(world.pairs.begin(), world.pairs.end(),
                                       [](const Pair& x, const Pair& y) { return x.time < y.time; });
    if (next == world.pairs.end() || next->time >= dt) break;
    now = next->time;
    next->known = false;           // whatever happens now, this pair must be asked again
    if (!next->contact) continue;  // proved clear only until now
    const bool was_stalled = next->stalled;

    // All contacts of this instant, together.
    const Island island = touching_island(world, *next, now, report);
    solve_island(world, island, now, report, on_impact);
    if (on_instant) on_instant(world, now);

    // No gap left to spend, and still closing in: impacts would pile up without end.
    if (!was_stalled) continue;
    find_next_contact(world, *next, now, dt, report);
    if (next->stalled) hold(world, island, now);
  }
  // ANCHOR_END: step

  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body) {
    Body& b = world.bodies[body];
    if (b.held) report.lost_time = std::max(report.lost_time, dt - b.time);
    b = {world.state_at(body, dt), 0, b.shape, false};
  }
  report.step_ns = ns_since(start);
  report.ccd_ns = report.step_ns - report.lcp_ns;
  return report;
}

}  // namespace fc::world

#include "ch05_resting_contact/resting.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

namespace fc::resting {
namespace {

// Of what a gap lacks to half the envelope, so much is made up in a frame; and no body is moved by more than
// this part of the envelope, so that bodies outside each other's shells stay apart.
constexpr double kSteerShare = 0.2, kMostSteered = 0.2;

// A contact with a gap of less than so many tolerances has no way left.
constexpr double kNoWay = 2;

constexpr double kSteerResidual = 1e-4;
constexpr int kMostHalvings = 6;

// A body in contact whose points are slower than this part of the envelope in a frame stands still: below it
// is round-off of impulses that cancel.
constexpr double kStill = 1e-9;

using Clock = std::chrono::steady_clock;

std::int64_t ns_since(Clock::time_point start) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
}

// Bodies that impulses can move, joined by contacts; contacts by island.
struct Islands {
  std::vector<std::vector<int>> contacts;  // of each island, ascending

  Islands(const world::World& world, const std::vector<ShellContact>& shell, const std::vector<char>& taken) {
    std::vector<int> parent(world.bodies.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int body) {
      while (parent[static_cast<std::size_t>(body)] != body)
        body = parent[static_cast<std::size_t>(body)] =
            parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(body)])];
      return body;
    };
    const auto owner = [&](const lcp::Contact& c) { return world.yields(c.body_a) ? c.body_a : c.body_b; };
    for (std::size_t i = 0; i < shell.size(); ++i) {
      const lcp::Contact& c = shell[i].contact;
      if (taken[i] && world.yields(c.body_a) && world.yields(c.body_b))
        parent[static_cast<std::size_t>(root(c.body_a))] = root(c.body_b);
    }
    std::vector<int> island_of(world.bodies.size(), -1);
    for (std::size_t i = 0; i < shell.size(); ++i) {
      if (!taken[i]) continue;
      int& island = island_of[static_cast<std::size_t>(root(owner(shell[i].contact)))];
      if (island < 0) {
        island = static_cast<int>(contacts.size());
        contacts.emplace_back();
      }
      contacts[static_cast<std::size_t>(island)].push_back(static_cast<int>(i));
    }
  }
};

// The bodies of an island with contacts between them by their places here.
struct Local {
  std::vector<int> numbers;
  std::vector<RigidBody> bodies;
  std::vector<lcp::Contact> contacts;

  Local(const world::World& world, const std::vector<ShellContact>& shell, const std::vector<int>& island,
        std::vector<int>& place) {
    const auto local = [&](int body) {
      int& at = place[static_cast<std::size_t>(body)];
      if (at < 0) {
        at = static_cast<int>(numbers.size());
        numbers.push_back(body);
        bodies.push_back(world.bodies[static_cast<std::size_t>(body)].state);
      }
      return at;
    };
    for (const int i : island) {
      contacts.push_back(shell[static_cast<std::size_t>(i)].contact);
      contacts.back().body_a = local(contacts.back().body_a);
      contacts.back().body_b = local(contacts.back().body_b);
    }
    for (const int body : numbers) place[static_cast<std::size_t>(body)] = -1;
  }
};

// Whether every pair in contact keeps half of its gap, or half of the envelope's middle, from the local
// bodies to the moved ones.
bool keeps_gaps(const world::World& world, const Local& local, const std::vector<RigidBody>& moved,
                double middle) {
  std::pair<int, int> last(-1, -1);
  for (std::size_t i = 0; i < local.contacts.size(); ++i) {
    const lcp::Contact& c = local.contacts[i];
    if (std::pair(c.body_a, c.body_b) == last) continue;  // contacts of a pair stand together
    last = {c.body_a, c.body_b};
    double gap = c.gap;
    for (std::size_t k = i + 1; k < local.contacts.size(); ++k) {
      if (std::pair(local.contacts[k].body_a, local.contacts[k].body_b) != last) break;
      gap = std::min(gap, local.contacts[k].gap);
    }
    const auto a = static_cast<std::size_t>(c.body_a), b = static_cast<std::size_t>(c.body_b);
    const ca::PairPose pose(ca::Motion(moved[a]), ca::Motion(moved[b]), 0);
    const double after =
        hulls::model_distance(world.model_of(local.numbers[a]), world.model_of(local.numbers[b]), pose,
                              world.tolerance, 0.5 * middle)
            .lower;
    if (after < 0.5 * std::min(gap, middle) && after < gap) return false;
  }
  return true;
}

}  // namespace

Resting::Resting(const Scene& scene, world::World& world, double dt)
    : shell_(envelope_of(scene, world)), dt_(dt) {
  world.rest_speed = shell_.envelope() / dt;
  world.touch = shell_.envelope();
}

// ANCHOR: step
RestReport Resting::step(world::World& world, const world::Listeners& listeners) {
  const Clock::time_point start = Clock::now();
  RestReport report;
  for (world::Body& body : world.bodies) body.supported = false;
  shell_.find(world);
  solve_islands(world, listeners, report);
  const world::StepReport events =
      world::step(world, dt_, listeners);  // chapter 4: what is no resting contact
  const world::StepReport resting = report.step;
  report.step = events;
  report.step.contacts += resting.contacts;
  report.step.impacts += resting.impacts;
  report.step.lcp_rows += resting.lcp_rows;
  report.step.solves += resting.solves;
  report.step.lcp_residual = std::max(events.lcp_residual, resting.lcp_residual);
  report.step.min_gap = std::min(events.min_gap, report.smallest_gap);
  report.step.max_penetration = std::max(events.max_penetration, -std::min(0.0, report.smallest_gap));
  steer(world, report);
  report.step.step_ns = ns_since(start);
  report.step.lcp_ns += report.solve_ns;
  report.step.ccd_ns = report.step.step_ns - report.step.lcp_ns;
  return report;
}
// ANCHOR_END: step

void Resting::solve_islands(world::World& world, const world::Listeners& listeners, RestReport& report) {
  std::vector<ShellContact>& shell = shell_.contacts();
  const double middle = 0.5 * shell_.envelope(), fast = shell_.envelope() / dt_;
  report.searched = shell_.searched();
  report.shell_contacts = static_cast<int>(shell.size());
  report.smallest_gap = shell_.smallest_gap();

  std::vector<RigidBody> states;
  for (const world::Body& body : world.bodies) states.push_back(body.state);
  std::vector<char> taken(shell.size());
  for (std::size_t i = 0; i < shell.size(); ++i) {
    // What comes in faster than the shell allows is an impact, and chapter 4's.
    // (Unless it has no way left to come in: then it is stopped here, without a bounce.)
    const bool slow = -lcp::contact_velocity(states, shell[i].contact) <= fast;
    taken[i] = slow || shell[i].contact.gap < kNoWay * world.tolerance;
    if (!taken[i]) shell[i].impulse = 0;
  }
  const Islands islands(world, shell, taken);
  std::vector<int> place(world.bodies.size(), -1);
  for (const std::vector<int>& island : islands.contacts) {
    Local local(world, shell, island, place);
    // The velocities that gravity would make of them by the frame's end.
    // (One that was held did not live through the last frame: it has that frame's gravity already.)
    if (world.effects.gravity)
      for (std::size_t k = 0; k < local.bodies.size(); ++k)
        if (!local.bodies[k].is_static() &&
            !world.bodies[static_cast<std::size_t>(local.numbers[k])].was_held)
          local.bodies[k].velocity += dt_ * *world.effects.gravity;
    std::vector<double> allowed, impulses;
    for (const int i : island) {
      allowed.push_back(std::max(0.0, shell[static_cast<std::size_t>(i)].contact.gap - middle) / dt_);
      impulses.push_back(shell[static_cast<std::size_t>(i)].impulse);
    }
    std::vector<double> before;
    for (const lcp::Contact& contact : local.contacts)
      before.push_back(lcp::contact_velocity(local.bodies, contact));
    const Clock::time_point start = Clock::now();
    const IslandResult result = solver_.solve(local.bodies, local.contacts, allowed, impulses, options_);
    report.solve_ns += ns_since(start);
    FC_CHECK(result.solved, "the resting contacts of an island could not be solved");
    report.sweeps += result.sweeps;
    report.shell_residual = std::max(report.shell_residual, result.residual);
    report.largest_island = std::max(report.largest_island, static_cast<int>(island.size()));
    report.step.contacts += static_cast<int>(island.size());
    report.step.lcp_rows += static_cast<int>(island.size());
    ++report.step.solves;
    report.step.lcp_residual = std::max(report.step.lcp_residual, result.residual);

    std::vector<char> pushed(local.bodies.size());
    for (std::size_t k = 0; k < island.size(); ++k) {
      ShellContact& contact = shell[static_cast<std::size_t>(island[k])];
      contact.impulse = impulses[k];
      if (!(impulses[k] > 0)) continue;
      pushed[static_cast<std::size_t>(local.contacts[k].body_a)] = 1;
      pushed[static_cast<std::size_t>(local.contacts[k].body_b)] = 1;
      ++report.shell_impulses;
      ++report.step.impacts;
      if (listeners.impact)
        listeners.impact(
            {0,
             contact.contact,
             {0, 0, before[k], lcp::contact_velocity(local.bodies, local.contacts[k]), impulses[k]}});
    }
    for (std::size_t k = 0; k < local.bodies.size(); ++k) {
      if (!pushed[k] || local.bodies[k].is_static()) continue;  // nothing pushed it: it falls, in closed form
      RigidBody state = local.bodies[k];
      const double reach = world
                               .shapes[static_cast<std::size_t>(
                                   world.bodies[static_cast<std::size_t>(local.numbers[k])].shape)]
                               .reach;
      if ((state.velocity.norm() + reach * state.spin.norm()) * dt_ < kStill * shell_.envelope())
        state.velocity = state.spin = Vec3::Zero();
      world.bodies[static_cast<std::size_t>(local.numbers[k])].supported = true;
      world.set_course(local.numbers[k], state, 0);
    }
  }
  if (listeners.instant && report.shell_impulses > 0) listeners.instant(world, 0);
}

// Moves bodies, and leaves their velocities alone: the least motion (in the sense of kinetic energy) that
// brings every gap a part of the way to the envelope's middle, and no other gap below it.
void Resting::steer(world::World& world, RestReport& report) {
  const double middle = 0.5 * shell_.envelope();
  const bool low = std::any_of(shell_.contacts().begin(), shell_.contacts().end(),
                               [&](const ShellContact& c) { return c.contact.gap < middle * (1 - 1e-3); });
  if (!low) return;
  shell_.find(world);  // as they are now
  std::vector<ShellContact>& shell = shell_.contacts();
  const std::vector<char> taken(shell.size(), 1);
  const Islands islands(world, shell, taken);
  std::vector<int> place(world.bodies.size(), -1);
  for (const std::vector<int>& island : islands.contacts) {
    double lowest = middle;
    for (const int i : island) lowest = std::min(lowest, shell[static_cast<std::size_t>(i)].contact.gap);
    if (lowest >= middle * (1 - 1e-3)) continue;
    Local local(world, shell, island, place);
    std::vector<double> impulses(island.size(), 0), allowed;
    // In units of one step of "time" 1: displacements are velocities. A gap may shrink by what it has above
    // the middle; one below it must grow, which is a row that starts by closing in: a contact that would lose
    // `lack` if nothing were done.
    std::vector<lcp::Contact> contacts = local.contacts;
    std::vector<RigidBody> still = local.bodies;
    for (RigidBody& body : still) body.velocity = body.spin = Vec3::Zero();
    for (const int i : island) {
      const double gap = shell[static_cast<std::size_t>(i)].contact.gap;
      allowed.push_back(gap < middle ? -kSteerShare * (middle - gap) : gap - middle);
    }
    IslandOptions rough = options_;  // positions need no more: the next frame goes on
    rough.residual = rough.accepted = kSteerResidual;
    if (!solver_.solve(still, contacts, allowed, impulses, rough).solved) continue;
    double most = 0;
    for (std::size_t k = 0; k < still.size(); ++k) {
      const int number = local.numbers[k];
      const double reach =
          world.shapes[static_cast<std::size_t>(world.bodies[static_cast<std::size_t>(number)].shape)].reach;
      most = std::max(most, still[k].velocity.norm() + reach * still[k].spin.norm());
    }
    double shrink = most > kMostSteered * shell_.envelope() ? kMostSteered * shell_.envelope() / most : 1;
    // And no gap may lose more than a tenth of what it has: what the rough answer missed.
    for (std::size_t k = 0; k < island.size(); ++k) {
      const double gap = shell[static_cast<std::size_t>(island[k])].contact.gap;
      const double lost = -lcp::contact_velocity(still, contacts[k]) - std::max(0.0, gap - middle);
      if (lost > 0) shrink = std::min(shrink, std::max(0.0, 0.1 * gap / lost));
    }
    // The rows are straight, the bodies turn: look at every pair, and go half as far until no gap has lost
    // more than half.
    std::vector<RigidBody> moved;
    bool sound = false;
    for (int halvings = 0; halvings < kMostHalvings && !sound && shrink > 0; ++halvings) {
      moved = local.bodies;
      for (std::size_t k = 0; k < still.size(); ++k) {
        if (still[k].is_static()) continue;
        const Vec3 turn = shrink * still[k].spin;
        moved[k].position += shrink * still[k].velocity;
        if (turn.norm() > 0)
          moved[k].orientation =
              (Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * moved[k].orientation).normalized();
      }
      sound = keeps_gaps(world, local, moved, middle);
      if (!sound) shrink *= 0.5;
    }
    if (!sound) continue;
    report.steered = std::max(report.steered, shrink * most);
    for (std::size_t k = 0; k < still.size(); ++k) {
      if (still[k].is_static()) continue;
      if (world.effects.gravity)
        report.steering_energy -=
            moved[k].mass * world.effects.gravity->dot(moved[k].position - local.bodies[k].position);
      if (moved[k].position != local.bodies[k].position ||
          moved[k].orientation.coeffs() != local.bodies[k].orientation.coeffs())
        world.set_course(local.numbers[k], moved[k], 0);
    }
  }
}

}  // namespace fc::resting

#include "ch05_resting_contact/impact_law.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {
namespace {

// Of the margin: what is farther apart and comes in fast will be an event of its own.
constexpr double kThere = 0.6;

// After so many rounds in one instant nothing bounces any more.
constexpr int kMostBounces = 8;

double kinetic(const std::vector<RigidBody>& bodies) {
  double sum = 0;
  for (const RigidBody& body : bodies)
    if (!body.is_static()) sum += body.kinetic_energy();
  return sum;
}

// The second stage, after a compression by `impulses` from velocities `before` of the contacts: false if nothing gives back.
bool give_back(std::vector<RigidBody>& bodies, const std::vector<lcp::Contact>& contacts,
               const std::vector<double>& restitution, const std::vector<double>& impulses,
               std::vector<double>& total, const std::vector<double>& before) {
  std::vector<RigidBody> expanded = bodies;
  std::vector<double> back(contacts.size());
  bool any = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    back[i] = restitution[i] * impulses[i];
    if (!(back[i] > 0)) continue;
    any = true;
    lcp::apply_impulse(expanded, contacts[i], back[i]);
  }
  if (!any) return false;
  // ANCHOR: cap
  double gave = 0, takes = 0;  // z'Az and r'Ar, by what the impulses do to the velocities
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double compressed = lcp::contact_velocity(bodies, contacts[i]);
    gave += impulses[i] * (compressed - before[i]);
    takes += back[i] * (lcp::contact_velocity(expanded, contacts[i]) - compressed);
  }
  const double cap = takes > gave ? std::sqrt(std::max(0.0, gave) / takes) : 1;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!(back[i] > 0)) continue;
    lcp::apply_impulse(bodies, contacts[i], cap * back[i]);
    total[i] += cap * back[i];
  }
  // ANCHOR_END: cap
  return true;
}

}  // namespace

InstantResult resolve_instant(const world::World& world, Island& island, double margin, IslandSolver& solver,
                              const InstantOptions& options) {
  InstantResult result;
  std::vector<RigidBody> bodies;
  for (const Member& member : island.members) bodies.push_back(member.state);
  std::vector<lcp::Contact> contacts;
  std::vector<double> impulses, before, restitution;
  std::vector<char> comes_in;  // fast
  std::vector<std::uint64_t> keys;
  for (const IslandPair& pair : island.pairs) {
    const int number_a = island.members[static_cast<std::size_t>(pair.a)].number,
              number_b = island.members[static_cast<std::size_t>(pair.b)].number;
    const RigidBody &a = bodies[static_cast<std::size_t>(pair.a)],
                    &b = bodies[static_cast<std::size_t>(pair.b)];
    const Pose pose_a = a.pose(), pose_b = b.pose();
    for (const ContactPoint& point : pair.contacts->points) {
      const double gap = point.gap_at(pose_a, pose_b);
      if (gap > margin) continue;
      const bool bounces = options.bounces(number_a) && options.bounces(number_b);
      const lcp::Contact contact{pair.a,
                                 pair.b,
                                 point.middle(pose_a, pose_b),
                                 point.normal_at(pose_a, pose_b),
                                 gap,
                                 0,  // a compression has none
                                 world.turns(number_a),
                                 world.turns(number_b)};
      const double speed = lcp::contact_velocity(bodies, contact);
      const bool fast = speed < -options.rest_speed && !point.lasts;
      if (fast && gap > kThere * margin) continue;
      contacts.push_back(contact);
      restitution.push_back(bounces ? world.restitution_of(number_a, number_b) : 0);
      impulses.push_back(point.force * options.guess);
      before.push_back(speed);
      comes_in.push_back(fast);
      keys.push_back(point.key);
      result.impact = result.impact || fast;
    }
  }
  if (contacts.empty()) return result;
  const double rounding = lcp::approach_rounding(bodies, contacts);
  if (*std::min_element(before.begin(), before.end()) >= -rounding) return result;

  const double energy = kinetic(bodies);
  std::vector<double> allowed(contacts.size(), 0.0), total(contacts.size(), 0.0);
  const auto compress = [&] {
    const IslandResult solved = solver.solve(bodies, contacts, allowed, impulses, options.solver);
    result.residual = std::max(result.residual, solved.residual);
    result.steps += solved.steps;
    result.status = solved.status;
    result.rows += static_cast<int>(contacts.size());
    ++result.solves;
    for (std::size_t i = 0; i < contacts.size() && solved.solved; ++i) total[i] += impulses[i];
    return solved.solved;
  };
  const std::vector<RigidBody> start = bodies;
  std::vector<double> start_speeds = before;
  result.contacts = static_cast<int>(contacts.size());
  result.solved = compress();
  if (!result.solved) return result;
  for (int round = 0; result.impact; ++round) {
    if (!give_back(bodies, contacts, restitution, impulses, total, start_speeds)) break;
    double fastest = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      start_speeds[i] = lcp::contact_velocity(bodies, contacts[i]);
      fastest = std::min(fastest, start_speeds[i]);
    }
    if (fastest >= -rounding) break;
    std::fill(impulses.begin(), impulses.end(), 0.0);
    if (!compress()) return result.solved = false, result;
    if (round + 1 >= kMostBounces) break;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!(total[i] > 0)) continue;
    result.changed = true;
    result.kinematic_work += lcp::kinematic_work(start, contacts[i], total[i]);
    world::ImpactRecord record;
    record.time = options.time;
    record.contact = contacts[i];
    record.contact.body_a = island.members[static_cast<std::size_t>(contacts[i].body_a)].number;
    record.contact.body_b = island.members[static_cast<std::size_t>(contacts[i].body_b)].number;
    record.impulse = {static_cast<int>(i), 0, before[i], lcp::contact_velocity(bodies, contacts[i]),
                      total[i]};
    record.kind = comes_in[i] ? world::ContactKind::impact : world::ContactKind::rest;
    result.records.push_back(record);
    result.keys.push_back(keys[i]);
  }
  result.energy_gain = kinetic(bodies) - energy - result.kinematic_work;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (island.members[i].dynamic) island.members[i].state = bodies[i];
  return result;
}

}  // namespace fc::resting

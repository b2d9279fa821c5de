#include "ch05_resting_contact/impact_law.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {
namespace {

// A fast contact whose gap is above this share of the margin becomes an event of its own.
constexpr double kThere = 0.6;

// After this number of rounds in one instant nothing bounces.
constexpr int kMostBounces = 8;

double kinetic(const std::vector<RigidBody>& bodies) {
  double sum = 0;
  for (const RigidBody& body : bodies)
    if (!body.is_static()) sum += body.kinetic_energy();
  return sum;
}

// The points of an island that are in contact, and what is known of each before the instant.
struct Touching {
  std::vector<lcp::Contact> contacts;  // bodies by their places among the members; without restitution
  std::vector<double> restitution;
  std::vector<Vec3> guesses;  // N s, on B
  std::vector<char> is_fast;  // it approaches fast
  std::vector<char> lasts;    // a plan has pushed it until now
  std::vector<std::uint64_t> keys;
};

Touching touching(const world::World& world, const Island& island, std::span<const RigidBody> bodies,
                  double margin, const InstantOptions& options) {
  Touching result;
  for (const IslandPair& pair : island.pairs) {
    const int number_a = island.members[at(pair.a)].number, number_b = island.members[at(pair.b)].number;
    const bool bounces = options.bounces(number_a) && options.bounces(number_b);
    for (const ContactPoint& point : pair.contacts->points) {
      const lcp::Contact contact = contact_at(world, island.members, bodies, pair.a, pair.b, point);
      if (contact.gap > margin) continue;
      const bool fast = lcp::contact_velocity(bodies, contact) < -options.rest_speed && !point.lasts;
      if (fast && contact.gap > kThere * margin) continue;
      result.contacts.push_back(contact);
      result.restitution.push_back(bounces ? world.restitution_of(number_a, number_b) : 0);
      result.guesses.push_back(point.force * options.guess);
      result.is_fast.push_back(fast);
      result.lasts.push_back(point.lasts);
      result.keys.push_back(point.key);
    }
  }
  return result;
}

std::vector<Vec3> velocities_of(const ContactSet& set) {
  std::vector<Vec3> velocities;
  for (const lcp::Contact& contact : set.contacts)
    velocities.push_back(lcp::relative_velocity(set.bodies, contact));
  return velocities;
}

bool anything_closes(const ContactSet& set, double rounding) {
  return std::any_of(set.contacts.begin(), set.contacts.end(), [&](const lcp::Contact& contact) {
    return lcp::contact_velocity(set.bodies, contact) < -rounding;
  });
}

// The stages of one instant; the result counts what they do.
struct Stages {
  ContactSet set;
  const Touching& island;
  ContactLaw& law;
  const InstantOptions& options;
  InstantResult& result;
  std::vector<Vec3> total;  // N s, of each contact

  // Stops the closing of all contacts, or only of those that last. `impulses` comes in as a guess.
  bool compress(std::span<Vec3> impulses, bool all) {
    std::vector<std::size_t> which;
    std::vector<lcp::Contact> contacts;
    std::vector<Vec3> found;
    for (std::size_t i = 0; i < impulses.size(); ++i) {
      if (!all && !island.lasts[i]) continue;
      which.push_back(i);
      contacts.push_back(island.contacts[i]);
      found.push_back(impulses[i]);
    }
    if (contacts.empty()) return true;
    const std::vector<double> limits(contacts.size(), 0.0);
    const IslandResult solved = law.push({set.bodies, set.numbers, contacts}, limits, found, options.solver);
    result.residual = std::max(result.residual, solved.residual);
    result.steps += solved.steps;
    result.status = solved.status;
    result.rows += static_cast<int>(contacts.size());
    ++result.solves;
    if (!solved.solved) return false;
    for (std::size_t k = 0; k < which.size(); ++k) {
      impulses[which[k]] = found[k];
      total[which[k]] += found[k];
    }
    return true;
  }

  // The second stage, after a compression by `impulses` from the contacts' velocities `before` (m/s, see
  // relative_velocity). False if no contact gives back.
  bool give_back(const std::vector<Vec3>& impulses, const std::vector<Vec3>& before) {
    std::vector<RigidBody> expanded(set.bodies.begin(), set.bodies.end());
    std::vector<double> back(set.contacts.size());
    bool any = false;
    for (std::size_t i = 0; i < back.size(); ++i) {
      back[i] = island.restitution[i] * impulses[i].dot(set.contacts[i].normal);
      if (!(back[i] > 0)) continue;
      any = true;
      lcp::apply_impulse(expanded, set.contacts[i], back[i]);
    }
    if (!any) return false;
    // ANCHOR: cap
    double gave = 0, takes = 0;  // z'Az and r'Ar, from what the impulses do to the velocities
    for (std::size_t i = 0; i < back.size(); ++i) {
      const Vec3 compressed = lcp::relative_velocity(set.bodies, set.contacts[i]);
      gave += impulses[i].dot(compressed - before[i]);
      takes += back[i] *
               set.contacts[i].normal.dot(lcp::relative_velocity(expanded, set.contacts[i]) - compressed);
    }
    const double cap = takes > gave ? std::sqrt(std::max(0.0, gave) / takes) : 1;
    for (double& normal : back) normal *= cap;
    law.give_back(set, back, total);
    // ANCHOR_END: cap
    return true;
  }

  // Both stages, repeated as long as something closes. Before an impact, the other half of what plans have pushed until
  // now is stopped: it is no part of the impact, and does not bounce. False if a stage could not be solved.
  bool stop_what_closes(double rounding) {
    std::vector<Vec3> impulses = island.guesses;
    if (result.impact && !compress(impulses, false)) return false;
    for (int round = 0;; ++round) {
      if (result.impact) std::fill(impulses.begin(), impulses.end(), Vec3::Zero());
      const std::vector<Vec3> before = velocities_of(set);
      if (!compress(impulses, true)) return false;
      if (!result.impact || round == kMostBounces || !give_back(impulses, before) ||
          !anything_closes(set, rounding))
        return true;
    }
  }
};

}  // namespace

world::ImpactRecord record_of(double time, const lcp::Contact& contact, const Vec3& before, const Vec3& after,
                              const Vec3& impulse, world::ContactKind kind) {
  const Vec3& n = contact.normal;
  const double normal = n.dot(impulse);
  world::ImpactRecord record{time, contact, {0, 0, n.dot(before), n.dot(after), normal}, kind};
  record.tangential = impulse - normal * n;
  record.slip_before = before - n.dot(before) * n;
  record.slip_after = after - n.dot(after) * n;
  return record;
}

InstantResult resolve_instant(const world::World& world, Island& island, double margin, ContactLaw& law,
                              const InstantOptions& options) {
  InstantResult result;
  std::vector<RigidBody> bodies;
  std::vector<int> numbers;
  for (const Member& member : island.members) {
    bodies.push_back(member.state);
    numbers.push_back(member.number);
  }
  const std::vector<RigidBody> start = bodies;
  const Touching points = touching(world, island, bodies, margin, options);
  if (points.contacts.empty()) return result;
  result.impact = std::find(points.is_fast.begin(), points.is_fast.end(), 1) != points.is_fast.end();
  const double rounding = lcp::approach_rounding(bodies, points.contacts);
  Stages stages{{bodies, numbers, points.contacts}, points, law, options, result, {}};
  if (!anything_closes(stages.set, rounding)) return result;

  result.contacts = static_cast<int>(points.contacts.size());
  stages.total.assign(points.contacts.size(), Vec3::Zero());
  result.solved = stages.stop_what_closes(rounding);
  if (!result.solved) return result;
  for (std::size_t i = 0; i < points.contacts.size(); ++i) {
    lcp::Contact contact = points.contacts[i];
    const Vec3 impulse = stages.total[i];
    if (!(impulse.dot(contact.normal) > 0)) continue;
    result.kinematic_work += lcp::kinematic_work(start, contact, impulse);
    const Vec3 before = lcp::relative_velocity(start, contact),
               after = lcp::relative_velocity(bodies, contact);
    contact.body_a = numbers[at(contact.body_a)];
    contact.body_b = numbers[at(contact.body_b)];
    result.records.push_back(
        record_of(options.time, contact, before, after, impulse,
                  points.is_fast[i] ? world::ContactKind::impact : world::ContactKind::rest));
    result.keys.push_back(points.keys[i]);
  }
  result.energy_gain = kinetic(bodies) - kinetic(start) - result.kinematic_work;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (island.members[i].dynamic) island.members[i].state = bodies[i];
  return result;
}

}  // namespace fc::resting

#include "ch05_resting_contact/impact_law.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/impact.hpp"
#include "ch05_resting_contact/rest_records.hpp"

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

// The second stage, after a compression by `impulses` from velocities `before` of the contacts (m/s, see relative_velocity):
// false if nothing gives back.
bool give_back(const ContactSet& set, ContactLaw& law, const std::vector<double>& restitution,
               const std::vector<Vec3>& impulses, std::vector<Vec3>& total, const std::vector<Vec3>& before) {
  std::vector<RigidBody> expanded(set.bodies.begin(), set.bodies.end());
  std::vector<double> back(set.contacts.size());
  bool any = false;
  for (std::size_t i = 0; i < back.size(); ++i) {
    back[i] = restitution[i] * impulses[i].dot(set.contacts[i].normal);
    if (!(back[i] > 0)) continue;
    any = true;
    lcp::apply_impulse(expanded, set.contacts[i], back[i]);
  }
  if (!any) return false;
  // ANCHOR: cap
  double gave = 0, takes = 0;  // z'Az and r'Ar, by what the impulses do to the velocities
  for (std::size_t i = 0; i < back.size(); ++i) {
    const Vec3 compressed = lcp::relative_velocity(set.bodies, set.contacts[i]);
    gave += impulses[i].dot(compressed - before[i]);
    takes +=
        back[i] * set.contacts[i].normal.dot(lcp::relative_velocity(expanded, set.contacts[i]) - compressed);
  }
  const double cap = takes > gave ? std::sqrt(std::max(0.0, gave) / takes) : 1;
  for (double& normal : back) normal *= cap;
  law.give_back(set, back, total);
  // ANCHOR_END: cap
  return true;
}

// The points of an island that are in contact, and what is known of each before the instant.
struct Touching {
  std::vector<lcp::Contact>
      contacts;  // bodies by their places among the members; a compression has no restitution
  std::vector<double> restitution;
  std::vector<Vec3> guesses;  // N s, on B
  std::vector<char> is_fast;  // it comes in fast
  std::vector<char> lasts;    // a plan has pushed it up to now
  std::vector<std::uint64_t> keys;
};

Touching touching(const world::World& world, const Island& island, std::span<const RigidBody> bodies,
                  double margin, const InstantOptions& options) {
  Touching result;
  for (const IslandPair& pair : island.pairs) {
    const int number_a = island.members[at(pair.a)].number, number_b = island.members[at(pair.b)].number;
    const Pose pose_a = bodies[at(pair.a)].pose(), pose_b = bodies[at(pair.b)].pose();
    const bool bounces = options.bounces(number_a) && options.bounces(number_b);
    for (const ContactPoint& point : pair.contacts->points) {
      const double gap = point.gap_at(pose_a, pose_b);
      if (gap > margin) continue;
      const lcp::Contact contact{
          pair.a, pair.b, point.middle(pose_a, pose_b), point.normal_at(pose_a, pose_b),
          gap,    0,      world.turns(number_a),        world.turns(number_b)};
      const bool fast = lcp::contact_velocity(bodies, contact) < -options.rest_speed && !point.lasts;
      if (fast && gap > kThere * margin) continue;
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

// The stages of one instant; what they do is counted in its result.
struct Stages {
  ContactSet set;
  const Touching& island;
  ContactLaw& law;
  const InstantOptions& options;
  InstantResult& result;
  std::vector<Vec3> total;  // N s, of each contact

  bool compress(std::span<const lcp::Contact> contacts, std::span<Vec3> impulses) {
    const std::vector<double> limits(contacts.size(), 0.0);
    const IslandResult solved =
        law.push({set.bodies, set.numbers, contacts}, limits, impulses, options.solver);
    result.residual = std::max(result.residual, solved.residual);
    result.steps += solved.steps;
    result.status = solved.status;
    result.rows += static_cast<int>(contacts.size());
    ++result.solves;
    return solved.solved;
  }

  // Before an impact: the other half of what plans have pushed up to now. It is no part of the impact, and does not bounce.
  bool stop_what_lasts() {
    std::vector<std::size_t> which;
    std::vector<lcp::Contact> contacts;
    std::vector<Vec3> impulses;
    for (std::size_t i = 0; i < island.contacts.size(); ++i) {
      if (!island.lasts[i]) continue;
      which.push_back(i);
      contacts.push_back(island.contacts[i]);
      impulses.push_back(island.guesses[i]);
    }
    if (contacts.empty()) return true;
    if (!compress(contacts, impulses)) return false;
    for (std::size_t k = 0; k < which.size(); ++k) total[which[k]] += impulses[k];
    return true;
  }

  // Both stages, again as long as something closes. False if one could not be solved.
  bool stop_what_closes(double rounding) {
    std::vector<Vec3> impulses = island.guesses;
    if (result.impact) {
      if (!stop_what_lasts()) return false;
      std::fill(impulses.begin(), impulses.end(), Vec3::Zero());
    }
    for (int round = 0; round <= kMostBounces; ++round) {
      const std::vector<Vec3> before = velocities_of(set);
      if (!compress(set.contacts, impulses)) return false;
      for (std::size_t i = 0; i < total.size(); ++i) total[i] += impulses[i];
      if (!result.impact || round == kMostBounces) break;
      if (!give_back(set, law, island.restitution, impulses, total, before)) break;
      if (!anything_closes(set, rounding)) break;
      std::fill(impulses.begin(), impulses.end(), Vec3::Zero());
    }
    return true;
  }
};

}  // namespace

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

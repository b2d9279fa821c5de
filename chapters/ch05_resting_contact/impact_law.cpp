#include "ch05_resting_contact/impact_law.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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

// The points of an island that are in contact, and what is known of each before the instant.
struct Touching {
  std::vector<lcp::Contact>
      contacts;                // bodies by their places among the members; a compression has no restitution
  std::vector<double> speeds;  // m/s
  std::vector<double> restitution;
  std::vector<double> guesses;  // N s
  std::vector<char> is_fast;    // it comes in fast
  std::vector<char> lasts;      // a plan has pushed it up to now
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
      const double speed = lcp::contact_velocity(bodies, contact);
      const bool fast = speed < -options.rest_speed && !point.lasts;
      if (fast && gap > kThere * margin) continue;
      result.contacts.push_back(contact);
      result.speeds.push_back(speed);
      result.restitution.push_back(bounces ? world.restitution_of(number_a, number_b) : 0);
      result.guesses.push_back(point.force * options.guess);
      result.is_fast.push_back(fast);
      result.lasts.push_back(point.lasts);
      result.keys.push_back(point.key);
    }
  }
  return result;
}

// Some contacts of an instant; what their impulses do is reported in its result.
bool compress(std::vector<RigidBody>& bodies, const std::vector<lcp::Contact>& contacts,
              std::vector<double>& impulses, IslandSolver& solver, const InstantOptions& options,
              InstantResult& result) {
  const std::vector<double> approach_limits(contacts.size(), 0.0);
  const IslandResult solved = solver.solve(bodies, contacts, approach_limits, impulses, options.solver);
  result.residual = std::max(result.residual, solved.residual);
  result.steps += solved.steps;
  result.status = solved.status;
  result.rows += static_cast<int>(contacts.size());
  ++result.solves;
  return solved.solved;
}

std::vector<double> speeds_of(const std::vector<RigidBody>& bodies,
                              const std::vector<lcp::Contact>& contacts) {
  std::vector<double> speeds;
  for (const lcp::Contact& contact : contacts) speeds.push_back(lcp::contact_velocity(bodies, contact));
  return speeds;
}

// Before an impact: the other half of what plans have pushed up to now. It is no part of the impact, and does not bounce.
bool stop_what_lasts(std::vector<RigidBody>& bodies, const Touching& island, std::vector<double>& total,
                     IslandSolver& solver, const InstantOptions& options, InstantResult& result) {
  std::vector<std::size_t> which;
  std::vector<lcp::Contact> contacts;
  std::vector<double> impulses;
  for (std::size_t i = 0; i < island.contacts.size(); ++i) {
    if (!island.lasts[i]) continue;
    which.push_back(i);
    contacts.push_back(island.contacts[i]);
    impulses.push_back(island.guesses[i]);
  }
  if (contacts.empty()) return true;
  if (!compress(bodies, contacts, impulses, solver, options, result)) return false;
  for (std::size_t k = 0; k < which.size(); ++k) total[which[k]] += impulses[k];
  return true;
}

// Both stages, again as long as something closes; N s of each contact, in all. Nothing if a stage could not be solved.
std::optional<std::vector<double>> stop_what_closes(std::vector<RigidBody>& bodies, const Touching& island,
                                                    double rounding, IslandSolver& solver,
                                                    const InstantOptions& options, InstantResult& result) {
  const std::vector<lcp::Contact>& contacts = island.contacts;
  std::vector<double> impulses = island.guesses, speeds = island.speeds, total(contacts.size(), 0.0);
  if (result.impact) {
    if (!stop_what_lasts(bodies, island, total, solver, options, result)) return {};
    std::fill(impulses.begin(), impulses.end(), 0.0);
    speeds = speeds_of(bodies, contacts);
  }
  for (int round = 0; round <= kMostBounces; ++round) {
    if (!compress(bodies, contacts, impulses, solver, options, result)) return {};
    for (std::size_t i = 0; i < contacts.size(); ++i) total[i] += impulses[i];
    if (!result.impact || round == kMostBounces) break;
    if (!give_back(bodies, contacts, island.restitution, impulses, total, speeds)) break;
    speeds = speeds_of(bodies, contacts);
    if (*std::min_element(speeds.begin(), speeds.end()) >= -rounding) break;
    std::fill(impulses.begin(), impulses.end(), 0.0);
  }
  return total;
}

}  // namespace

InstantResult resolve_instant(const world::World& world, Island& island, double margin, IslandSolver& solver,
                              const InstantOptions& options) {
  InstantResult result;
  std::vector<RigidBody> bodies;
  for (const Member& member : island.members) bodies.push_back(member.state);
  const std::vector<RigidBody> start = bodies;
  const Touching points = touching(world, island, bodies, margin, options);
  if (points.contacts.empty()) return result;
  result.impact = std::find(points.is_fast.begin(), points.is_fast.end(), 1) != points.is_fast.end();
  const double rounding = lcp::approach_rounding(bodies, points.contacts);
  if (*std::min_element(points.speeds.begin(), points.speeds.end()) >= -rounding) return result;

  result.contacts = static_cast<int>(points.contacts.size());
  const auto total = stop_what_closes(bodies, points, rounding, solver, options, result);
  result.solved = total.has_value();
  if (!total) return result;
  for (std::size_t i = 0; i < points.contacts.size(); ++i) {
    const double impulse = (*total)[i];
    if (!(impulse > 0)) continue;
    result.kinematic_work += lcp::kinematic_work(start, points.contacts[i], impulse);
    world::ImpactRecord record;
    record.time = options.time;
    record.contact = points.contacts[i];
    record.impulse = {static_cast<int>(i), 0, points.speeds[i], lcp::contact_velocity(bodies, record.contact),
                      impulse};
    record.contact.body_a = island.members[at(record.contact.body_a)].number;
    record.contact.body_b = island.members[at(record.contact.body_b)].number;
    record.kind = points.is_fast[i] ? world::ContactKind::impact : world::ContactKind::rest;
    result.records.push_back(record);
    result.keys.push_back(points.keys[i]);
  }
  result.energy_gain = kinetic(bodies) - kinetic(start) - result.kinematic_work;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (island.members[i].dynamic) island.members[i].state = bodies[i];
  return result;
}

}  // namespace fc::resting

#include "ch05_resting_contact/clear/clear_resting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch05_resting_contact/clear/clear_plan.hpp"
#include "ch05_resting_contact/envelope.hpp"
#include "common/scene_failure.hpp"

namespace fc::resting {

using world::ContactKind;
using world::Listeners;
using world::World;

namespace {

constexpr int kMostBounces = 8;            // in one instant; then nothing bounces any more
constexpr double kShortest = 1.0 / 65536;  // of a frame: no plan is shorter

std::vector<RigidBody> states_of(const std::vector<Member>& members) {
  std::vector<RigidBody> states;
  for (const Member& member : members) states.push_back(member.state);
  return states;
}

// Whether any contact closes faster than round-off.
bool anything_closes(const std::vector<RigidBody>& bodies, const std::vector<lcp::Contact>& contacts) {
  const double rounding = lcp::approach_rounding(bodies, contacts);
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const lcp::Contact& c) { return lcp::contact_velocity(bodies, c) < -rounding; });
}

void apply(std::vector<RigidBody>& bodies, const std::vector<lcp::Contact>& contacts, const VecX& impulses) {
  for (int i = 0; i < std::ssize(contacts); ++i)
    if (const double z = impulses[i]; z > 0) lcp::apply_impulse(bodies, contacts[i], z);
}

// The impulses between two sets of velocities, as records for listeners: bodies by their numbers in the world.
std::vector<world::ImpactRecord> records_of(const std::vector<Member>& members,
                                            const std::vector<RigidBody>& before,
                                            const std::vector<RigidBody>& after,
                                            const std::vector<lcp::Contact>& contacts, const VecX& impulses,
                                            double time, ContactKind kind) {
  std::vector<world::ImpactRecord> records;
  for (int i = 0; i < std::ssize(contacts); ++i) {
    if (!(impulses[i] > 0)) continue;
    const double v_before = lcp::contact_velocity(before, contacts[i]),
                 v_after = lcp::contact_velocity(after, contacts[i]);
    records.push_back({time, contacts[i], {i, 0, v_before, v_after, impulses[i]}, kind});
    for (int* body : {&records.back().contact.body_a, &records.back().contact.body_b})
      *body = members[*body].number;
  }
  return records;
}

SceneFailure failure(const char* what, int rows) {
  return SceneFailure(
      fmt::format("{} connected contacts {}; shorten step.dt, or take less unequal masses", rows, what),
      "envelope");
}

// The points of an island that are in contact.
struct Touching {
  std::vector<lcp::Contact> contacts;  // bodies by their places among the members
  VecX restitution;
  std::vector<int> lasting;  // contacts of bodies that a plan has pushed until now
  double fastest = 0;        // m/s: how fast the fastest of the others approaches, < 0
};

Touching touching(const World& world, const Island& island, const std::vector<RigidBody>& bodies,
                  double margin) {
  Touching result;
  std::vector<double> e;
  for (const IslandPair& pair : island.pairs)
    for (const ContactPoint& point : pair.contacts->points) {
      const lcp::Contact contact = contact_at(world, island.members, bodies, pair.a, pair.b, point);
      if (contact.gap > margin) continue;
      result.contacts.push_back(contact);
      e.push_back(world.restitution_of(pair.contacts->a, pair.contacts->b));
      if (point.lasts)
        result.lasting.push_back(static_cast<int>(e.size()) - 1);
      else
        result.fastest = std::min(result.fastest, lcp::contact_velocity(bodies, contact));
    }
  result.restitution = Eigen::Map<const VecX>(e.data(), std::ssize(e));
  return result;
}

}  // namespace

ClearResting::ClearResting(const Scene& scene, World& world, double dt, const clear::Pieces& pieces)
    : resting_step_(pieces.resting_step),
      solve_lcp_(pieces.solve_lcp()),
      contacts_(world, envelope_of(scene, world, dt)),
      islands_(contacts_, world.bodies.size()),
      no_piles_(world.bodies.size(), -1),
      frame_(dt),
      dt_(dt) {
  const auto refuse = [&](const char* what) {
    throw InputError(scene.mark("envelope").value_or(SourceMark{scene.file.string()}),
                     fmt::format("the clear version does not handle {}; leave --clear and --mine out", what));
  };
  if (!std::all_of(world.shapes.begin(), world.shapes.end(), [](const Shape& s) { return s.convex(); }))
    refuse("meshes");
  if (world.effects.drag) refuse("drag");
  if (world.effects.sleep) refuse("sleep");
  if (world.effects.sensors) refuse("sensors");
  if (world.effects.gyroscopic) refuse("gyroscopic bodies");
  const SolverSpec usual, &solver = world.solver;
  if (solver.method != usual.method || solver.limit != usual.limit || solver.tolerance != usual.tolerance)
    refuse("solvers other than chapter 3's dantzig");
  world.rest_gap = 0.5 * envelope();
}

ClearReport ClearResting::step(World& world, const Listeners& listeners) {
  report_ = {};
  contacts_.next_frame();
  world::StepReport step = world::step_with(*this, world, frame_, listeners);
  step.contacts += report_.step.contacts;
  step.impacts += report_.step.impacts;
  report_.step = step;
  return report_;
}

// A frame begins, a plan ends, or two bodies meet: the bodies concerned get new plans.
std::vector<int> ClearResting::begin(World& world, double dt, world::StepReport&,
                                     const Listeners& listeners) {
  dt_ = dt;
  listeners_ = &listeners;
  plans_.clear();
  std::vector<int> bodies;
  for (int body = 0; body < std::ssize(world.bodies); ++body)
    if (world.is_dynamic(body)) bodies.push_back(body);
  return go_on(world, bodies, 0);
}

double ClearResting::next_end() const {
  double first = std::numeric_limits<double>::infinity();
  for (const Plan& plan : plans_)
    if (plan.runs) first = std::min(first, plan.end);
  return first;
}

std::vector<int> ClearResting::end_plans(World& world, double now, world::StepReport&,
                                         const Listeners& listeners) {
  listeners_ = &listeners;
  std::vector<int> bodies;
  for (const Plan& plan : plans_)
    if (plan.runs && plan.end <= now) bodies.insert(bodies.end(), plan.bodies.begin(), plan.bodies.end());
  return go_on(world, bodies, now);
}

std::vector<int> ClearResting::meet(World& world, int a, int b, double now, world::StepReport&,
                                    const Listeners& listeners) {
  listeners_ = &listeners;
  std::vector<int> bodies;
  for (const int body : {a, b})
    if (world.is_dynamic(body)) bodies.push_back(body);
  return go_on(world, bodies, now);
}

void ClearResting::report_impulses(const std::vector<world::ImpactRecord>& records, double share) {
  for (world::ImpactRecord record : records) {
    record.impulse.impulse *= share;
    if (share <= 0) continue;
    if (record.kind == ContactKind::impact) ++report_.step.impacts;
    if (listeners_->impact) listeners_->impact(record);
  }
}

// ANCHOR: step
// An instant: the plans of these bodies end, what closes in each island is stopped, and then the island gets a plan.
std::vector<int> ClearResting::go_on(World& world, std::vector<int> bodies, double now) {
  islands_.begin(now);
  std::vector<int> changed;
  for (int i = 0; i < std::ssize(bodies); ++i) {  // the list grows
    if (islands_.is_in_island(bodies[i])) continue;
    Island island = islands_.grow(world, bodies[i], no_piles_);
    for (Member& member : island.members) {
      if (!member.dynamic) continue;
      end_plan_of(world, member.number, now, bodies);
      world.advance_to(member.number, now, now);
      member.state = world.bodies[member.number].state;
      changed.push_back(member.number);
    }
    stop_what_closes(world, island, now);
    for (const Member& member : island.members)
      if (member.dynamic) world.set_motion(member.number, member.state, now);
    if (!island.pairs.empty() && now < dt_) plan(world, island, now);
  }
  return now < dt_ ? changed : std::vector<int>{};
}

// A plan for the island: to the frame's end, or half as long, and so on, until its paths can be proved.
void ClearResting::plan(World& world, const Island& island, double now) {
  for (double length = dt_ - now; length > kShortest * (dt_ - now); length *= 0.5) {
    ClearPlan made(world, contacts_, resting_step_, solve_lcp_, island, now, length);
    while (made.has_new_rows() && made.close_ends())
      if (made.prove()) return follow(world, made);
    ++report_.halved;
  }
  throw failure("have no plan that can be proved", island.points());
}
// ANCHOR_END: step

// ANCHOR: instant
// The instant's law. First the lasting contacts are stopped: their closing is the other half of the plan's force. Then
// (Poisson) a compression stops all that closes. If a contact came in fast, an expansion gives back the part e of each
// impulse, but never more energy than the compression took.
void ClearResting::stop_what_closes(const World& world, Island& island, double now) {
  const std::vector<RigidBody> before = states_of(island.members);
  const auto [contacts, restitution, lasting, fastest] = touching(world, island, before, envelope());
  const bool impact = fastest < -envelope() / dt_;
  report_.step.contacts += static_cast<int>(contacts.size());
  std::vector<RigidBody> bodies = before;
  VecX z, total = VecX::Zero(contacts.size());
  std::vector<lcp::Contact> last;
  for (const int i : lasting) last.push_back(contacts[i]);
  if (!clear::push(bodies, last, VecX::Zero(last.size()), solve_lcp_, z))
    throw failure("cannot be stopped", island.points());
  total(lasting) = z;
  for (int round = 1; round <= kMostBounces && anything_closes(bodies, contacts); ++round) {
    if (!clear::push(bodies, contacts, VecX::Zero(contacts.size()), solve_lcp_, z))
      throw failure("cannot be stopped", island.points());
    total += z;
    if (!impact || round == kMostBounces) continue;
    const MatX A = lcp::assemble(bodies, contacts).A;
    const VecX r = restitution.cwiseProduct(z);
    const double gave = z.dot(A * z), takes = r.dot(A * r), k = takes > gave ? std::sqrt(gave / takes) : 1;
    apply(bodies, contacts, k * r);
    total += k * r;
  }
  const auto kind = impact ? ContactKind::impact : ContactKind::rest;
  report_impulses(records_of(island.members, before, bodies, contacts, total, now, kind), 1);
  for (int i = 0; i < std::ssize(bodies); ++i) island.members[i].state = bodies[i];
}
// ANCHOR_END: instant

// ANCHOR: follow
// Planned bodies go straight on with y, while their velocities change evenly from v to w and the other half of gravity.
// All other bodies fly.
void ClearResting::follow(World& world, const ClearPlan& made) {
  const auto& [solved, z, c, w, y] = made.result;
  const double length = made.length;
  Plan plan{made.now, length == dt_ - made.now ? dt_ : made.now + length};
  std::vector<RigidBody> u = made.problem.bodies;
  std::vector<lcp::Contact> contacts;
  for (const clear::RestingRow& row : made.problem.rows) contacts.push_back(row.contact);
  for (int i = 0; i < std::ssize(made.members); ++i) {
    const Vec3 half = 0.5 * length * made.problem.gravity[i];
    u[i].velocity += half;
    if (!made.planned[i]) continue;
    const RigidBody& v = made.members[i].state;
    world.bodies[made.members[i].number].plan = {static_cast<int>(plans_.size()), y[i].velocity, y[i].spin,
                                                 (w[i].velocity + half - v.velocity) / length,
                                                 (w[i].spin - v.spin) / length};
    plan.bodies.push_back(made.members[i].number);
    plan.lift -= v.mass * 2 * half.dot(y[i].velocity - w[i].velocity);
  }
  plan.records = records_of(made.members, u, w, contacts, z, made.now, ContactKind::rest);
  made.remember();
  if (!plan.bodies.empty()) plans_.push_back(plan);
  ++report_.plans;
}

// All bodies of the plan are moved to where they are now; gravity and impulses have acted for their share of the time.
void ClearResting::end_plan_of(World& world, int body, double now, std::vector<int>& bodies) {
  const int number = world.bodies[body].plan.number;
  if (number < 0) return;
  Plan& plan = plans_[number];
  for (const int member : plan.bodies) {
    world.advance_to(member, now, now);
    world.bodies[member].plan = {};
    bodies.push_back(member);
  }
  const double share = (now - plan.start) / (plan.end - plan.start);
  report_impulses(plan.records, share);
  report_.correction_energy += share * plan.lift;
  plan.runs = false;
}
// ANCHOR_END: follow

}  // namespace fc::resting

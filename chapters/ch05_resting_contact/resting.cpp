#include "ch05_resting_contact/resting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ch03_impulse_lcp/unsolved.hpp"
#include "common/scene_failure.hpp"

namespace fc::resting {
namespace {

// A body that has met others so often within one frame does not bounce any more until its end: the time between bounces
// may shrink without end (compare the TC model, Luding and McNamara 1998).
constexpr int kMostBounces = 64;

// A plan is halved where its paths are not clear, down to this part of a frame.
constexpr double kShortest = 1.0 / 4096;

// A body in contact whose points are slower than this part of the margin in a frame stands still: below it is round-off of
// impulses that cancel.
constexpr double kStill = 1e-9;

constexpr double kBeforeEnd = 1e-9;  // of a frame

}  // namespace

Resting::Resting(const Scene& scene, world::World& world, double dt, const RestOptions& options)
    : contacts_(world, envelope_of(scene, world)),
      islands_(contacts_, world.bodies.size()),
      maker_(contacts_),
      options_(options),
      frame_(dt),
      dt_(dt),
      meetings_(world.bodies.size(), 0),
      try_length_(world.bodies.size(), std::numeric_limits<double>::infinity()),
      crowded_(world.bodies.size(), 0),
      energy_(world.bodies.size(), 0),
      still_(world.bodies.size(), 0) {
  const SolverSpec usual;
  const SolverSpec& solver = world.solver;
  if (solver.method != usual.method || solver.limit != usual.limit || solver.tolerance != usual.tolerance) {
    options_.small.chosen = solver;
    options_.pile = std::numeric_limits<int>::max();  // piles are solved by sweeps of their own
  }
  world.reserve = 0.5 * envelope();
}

RestReport Resting::step(world::World& world, const world::Listeners& listeners) {
  report_ = {};
  contacts_.next_frame();
  std::fill(meetings_.begin(), meetings_.end(), 0);
  const std::int64_t searched = contacts_.searched();
  rests_.clear();
  rest_keys_.clear();
  rest_of_.clear();
  const world::StepReport report = world::step_with(*this, world, frame_, listeners);
  report_.step = report;
  report_.step.min_gap = std::min(report.min_gap, report_.smallest_gap);
  report_.step.max_penetration = std::max(report.max_penetration, -std::min(0.0, report_.smallest_gap));
  report_.searched = contacts_.searched() - searched;
  report_.resting = static_cast<int>(rests_.size());
  if (listeners.impact)
    for (const world::ImpactRecord& record : rests_) listeners.impact(record);
  return report_;
}

std::vector<int> Resting::begin(world::World& world, double dt, world::StepReport& report,
                                const world::Listeners& listeners) {
  dt_ = dt;
  plans_.clear();
  free_plans_.clear();
  std::vector<int> bodies;
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
    if (world.yields(body) && !world.bodies[at(body)].asleep) bodies.push_back(body);
  find_crowds(world, bodies);
  return go_on(world, bodies, 0, report, listeners);
}

void Resting::find_crowds(const world::World& world, const std::vector<int>& bodies) {
  std::fill(crowded_.begin(), crowded_.end(), 0);
  islands_.begin(0);
  for (const int body : bodies) {
    if (islands_.is_in_island(body)) continue;
    const Island island = islands_.grow(world, body, crowded_, 0);
    if (island.points() <= options_.crowd) continue;
    for (const Member& member : island.members)
      if (member.dynamic) crowded_[at(member.number)] = 1;
  }
}

double Resting::next_end() const {
  double first = std::numeric_limits<double>::infinity();
  for (const Running& plan : plans_)
    if (plan.runs) first = std::min(first, plan.end);
  return first;
}

std::vector<int> Resting::end_plans(world::World& world, double now, world::StepReport& report,
                                    const world::Listeners& listeners) {
  std::vector<int> bodies;
  for (const Running& plan : plans_)
    if (plan.runs && plan.end <= now) bodies.insert(bodies.end(), plan.bodies.begin(), plan.bodies.end());
  return go_on(world, bodies, now, report, listeners);
}

std::vector<int> Resting::meet(world::World& world, int a, int b, double now, world::StepReport& report,
                               const world::Listeners& listeners) {
  ++meetings_[at(a)];
  ++meetings_[at(b)];
  std::vector<int> bodies;
  for (const int body : {a, b})
    if (world.yields(body)) bodies.push_back(body);
  return go_on(world, bodies, now, report, listeners);
}

// Ends the plan of a body, if it has one: all of its bodies stand where they are now, with the velocities that they have, and
// are added to the list. Rows have done their part.
void Resting::finish_plan_of(world::World& world, int body, double now, std::vector<int>& bodies,
                             world::StepReport& report) {
  const int number = world.bodies[at(body)].plan.number;
  if (number < 0) return;
  Running& plan = plans_[at(number)];
  const double share = (now - plan.start) / (plan.end - plan.start);
  const bool whole = now >= plan.end;
  for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
    const int member = plan.bodies[i];
    world.carry(member, now, now);
    world.bodies[at(member)].plan = {};
    if (whole) {
      world.bodies[at(member)].state.velocity += plan.arrivals[i].linear;
      world.bodies[at(member)].state.spin += plan.arrivals[i].angular;
    }
    if (member != body) bodies.push_back(member);
  }
  for (const PlannedRow& row : plan.rows) {
    if (!(share > 0) || (row.arrives && !whole)) continue;
    report_rest({row.arrives ? told_at(now) : plan.start, row.contact,
                 {0, 0, row.before, row.after, share * row.impulse}, world::ContactKind::rest},
                row.key);
  }
  report.kinematic_work += share * plan.work;
  plan.runs = false;
  free_plans_.push_back(number);
}

// What is left of a velocity in contact that does not move the body.
void Resting::come_to_rest(const world::World& world, Member& member) const {
  const double reach = world.shapes[at(world.bodies[at(member.number)].shape)].reach;
  const double speed = member.state.velocity.norm() + reach * member.state.spin.norm();
  if (dt_ * speed < kStill * envelope()) member.state.velocity = member.state.spin = Vec3::Zero();
}

double Resting::energy_of(const world::World& world, int body) const {
  const RigidBody& state = world.bodies[at(body)].state;
  return state.kinetic_energy() -
         (world.effects.gravity ? state.mass * world.effects.gravity->dot(state.position) : 0.0);
}

// These bodies, and all whom they are in contact with: their plans end, the instant's impact law acts, and they get new plans
// until the frame's end, or fly.
std::vector<int> Resting::go_on(world::World& world, std::vector<int> bodies, double now,
                                world::StepReport& report, const world::Listeners& listeners) {
  islands_.begin(now);
  std::vector<int> changed;
  for (std::size_t i = 0; i < bodies.size(); ++i) {  // the list grows
    const int body = bodies[i];
    if (islands_.is_in_island(body)) continue;
    Island island = islands_.grow(world, body, crowded_, dt_ - now);
    double before = 0;  // J
    const double work = report.kinematic_work;
    for (Member& member : island.members) {
      if (!member.dynamic) continue;
      finish_plan_of(world, member.number, now, bodies, report);
      world.carry(member.number, now, now);
      member.state = world.bodies[at(member.number)].state;
      changed.push_back(member.number);
      before += energy_[at(member.number)];
    }
    wake(world, island, report);
    for (const IslandPair& pair : island.pairs)
      report_.smallest_gap = std::min(report_.smallest_gap, pair.contacts->gap);
    report_.largest_island = std::max(report_.largest_island, island.points());
    resolve(world, island, now, report, listeners);
    double gained = work - report.kinematic_work - before;
    for (Member& member : island.members) {
      if (!member.dynamic) continue;
      if (!island.pairs.empty()) come_to_rest(world, member);
      world.set_course(member.number, member.state, now);
      energy_[at(member.number)] = energy_of(world, member.number);
      gained += energy_[at(member.number)];
    }
    if (now > 0) report_.correction_energy += std::max(0.0, gained);
    if (now < dt_) plan(world, island, now, report);
    if (now >= dt_ && world.effects.sleep) fall_asleep(world, island, report);
  }
  if (now >= dt_) changed.clear();
  return changed;
}

PlanOptions Resting::options_for(const Island& island) const {
  PlanOptions options;
  options.solver = options_.small;
  options.rest_speed = envelope() / dt_;
  options.exact = island.points() <= options_.crowd;
  if (!options.exact) {
    options.most_rounds = 3;
    options.closed = 0.01;
  }
  if (island.points() > options_.pile) {
    options.solver.most_dense_rows = 0;
    options.solver.most_sweeps = 40;
    options.solver.residual = 1e-3;
    options.solver.accepted = std::numeric_limits<double>::infinity();
    options.most_rounds = 1;
    options.closed = 0.05;
  }
  return options;
}

// A contact that lasts is reported once in a frame, if its normal stays: what its plan does, and what the instant at the
// plan's end does.
void Resting::report_rest(const world::ImpactRecord& record, std::uint64_t key) {
  constexpr double kSameNormal = 1e-14;
  const auto low = static_cast<std::uint64_t>(record.contact.body_a), high = static_cast<std::uint64_t>(record.contact.body_b);
  const auto [at_pair, first] = rest_of_.try_emplace(low << 32 | high, rests_.size());
  if (!first)
    for (std::size_t i = at_pair->second; i < rests_.size(); ++i) {
      world::ImpactRecord& known = rests_[i];
      if (rest_keys_[i] != key || known.contact.body_a != record.contact.body_a ||
          known.contact.body_b != record.contact.body_b ||
          (known.contact.normal - record.contact.normal).norm() > kSameNormal)
        continue;
      known.impulse.impulse += record.impulse.impulse;
      known.impulse.v_after = record.impulse.v_after;
      return;
    }
  rests_.push_back(record);
  rest_keys_.push_back(key);
}

// What happens at the frame's end is told a little before it: it belongs to this frame, whose velocities it makes.
double Resting::told_at(double now) const { return std::min(now, (1 - kBeforeEnd) * dt_); }

void Resting::resolve(world::World& world, Island& island, double now, world::StepReport& report,
                      const world::Listeners& listeners) {
  if (island.pairs.empty()) return;
  InstantOptions options;
  options.rest_speed = envelope() / dt_;
  options.time = told_at(now);
  options.guess = 0.5 * dt_;
  options.bounces = [&](int body) { return meetings_[at(body)] < kMostBounces; };
  options.solver = options_for(island).solver;
  InstantResult result = resolve_instant(world, island, envelope(), solver_, options);
  if (!result.solved && stop_kinematic(world, island, now, report))
    result = resolve_instant(world, island, envelope(), solver_, options);
  if (!result.solved && options_.small.chosen)
    throw lcp::unsolved(world.solver, result.status, result.sweeps, result.residual);
  if (!result.solved)
    throw SceneFailure(fmt::format("{} contacts that belong together could not be solved: a residual of {:.2g} was left; "
                                   "take less unequal masses",
                                   result.contacts, result.residual),
                       "envelope");
  report.contacts += result.contacts;
  report.lcp_rows += result.rows;
  report.solves += result.solves;
  report.lcp_residual = std::max(report.lcp_residual, result.residual);
  report.kinematic_work += result.kinematic_work;
  report.energy_gain = std::max(report.energy_gain, result.energy_gain);
  report_.sweeps += result.sweeps;
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    const world::ImpactRecord& record = result.records[i];
    const bool impact = record.kind == world::ContactKind::impact;
    if (impact) ++report.impacts;
    if (!impact)
      report_rest(record, result.keys[i]);
    else if (listeners.impact)
      listeners.impact(record);
  }
  if (result.impact && listeners.instant) {
    for (const Member& member : island.members)
      if (member.dynamic) world.set_course(member.number, member.state, now);
    listeners.instant(world, now);
  }
}

// Kinematic bodies of the island that are driven into what cannot give way stand still until the frame's end; whether there
// are any.
bool Resting::stop_kinematic(world::World& world, Island& island, double now, world::StepReport& report) {
  bool any = false;
  for (Member& member : island.members) {
    if (!world.carries(member.number)) continue;
    stop(world, member.number, now, report);
    member.state.velocity = member.state.spin = Vec3::Zero();
    any = true;
  }
  return any;
}

void Resting::stop(world::World& world, int kinematic, double now, world::StepReport& report) {
  world.carry(kinematic, now, now);
  world.bodies[at(kinematic)].held = true;
  report.lost_time = std::max(report.lost_time, dt_ - now);
}

// A plan for the bodies of the island that are in contact, as long as their paths can be proved, at most to the frame's end.
void Resting::plan(world::World& world, Island& island, double now, world::StepReport& report) {
  if (island.pairs.empty()) return;
  const PlanOptions options = options_for(island);
  for (const IslandPair& pair : island.pairs)
    for (ContactPoint& point : pair.contacts->points) point.lasts = false;
  double length = dt_ - now;
  for (const Member& member : island.members)
    if (member.dynamic) length = std::min(length, try_length_[at(member.number)]);
  if (length > 0.75 * (dt_ - now)) length = dt_ - now;
  const bool pile = island.points() > options_.crowd;
  PlanMaker::Result result;
  bool stopped = false;
  for (;;) {
    result = maker_.make(world, island, now, length, options);
    report_.checked += maker_.checked();
    report_.sweeps += maker_.sweeps();
    report.solves += maker_.solves();
    report.lcp_residual = std::max(report.lcp_residual, maker_.worst_residual());
    if (result == PlanMaker::Result::proved) break;
    if (result == PlanMaker::Result::meets && maker_.meeting() > kShortest * dt_) {
      length = std::min(maker_.meeting(), 0.999 * length);
      continue;
    }
    if (result == PlanMaker::Result::unsolved && !stopped && stop_kinematic(world, island, now, report)) {
      stopped = true;
      continue;
    }
    if (pile && result == PlanMaker::Result::unproved) break;
    if (length < kShortest * dt_) break;
    length *= 0.5;
  }
  if (result == PlanMaker::Result::unsolved && options_.small.chosen)
    throw lcp::unsolved(world.solver, maker_.status(), maker_.sweeps(), maker_.worst_residual());
  if (result == PlanMaker::Result::unsolved)
    throw SceneFailure(fmt::format("{} resting contacts that belong together could not be solved: a residual of {:.2g} was "
                                   "left; shorten step.dt, or take less unequal masses",
                                   island.points(), maker_.worst_residual()),
                       "envelope");
  if (result == PlanMaker::Result::unproved || result == PlanMaker::Result::meets) {
    int shortened = 0;
    double lost = maker_.shorten(world, shortened);
    const std::vector<int> blocked = maker_.blocked();
    if (!blocked.empty()) {  // they stand still until the frame's end
      for (const int body : blocked) {
        stop(world, body, now, report);
        for (Member& member : island.members)
          if (member.number == body) member.state.velocity = member.state.spin = Vec3::Zero();
      }
      shortened = 0;
      lost = 0;
      if (maker_.make(world, island, now, length, options) != PlanMaker::Result::proved)
        lost = maker_.shorten(world, shortened);
    }
    report_.shortened += shortened;
    report_.lost_impulse += lost;
  }
  for (const Member& member : island.members)
    if (member.dynamic) try_length_[at(member.number)] = 2 * length;
  start_plan(world, island, now, length);
}

void Resting::start_plan(world::World& world, const Island& island, double now, double length) {
  int number = static_cast<int>(plans_.size());
  if (free_plans_.empty()) {
    plans_.emplace_back();
  } else {
    number = free_plans_.back();
    free_plans_.pop_back();
  }
  Running& plan = plans_[at(number)];
  plan.runs = true;
  plan.start = now;
  plan.end = length == dt_ - now ? dt_ : now + length;
  plan.bodies.clear();
  plan.arrivals.clear();
  for (int i = 0; i < static_cast<int>(island.members.size()); ++i) {
    if (!island.members[at(i)].dynamic || !maker_.is_planned(i)) continue;
    world::Body& body = world.bodies[at(island.members[at(i)].number)];
    body.plan = maker_.plan_of(i);
    const double reach = world.shapes[at(body.shape)].reach;
    const double path = dt_ * (body.plan.linear.norm() + reach * body.plan.angular.norm());
    if (path < kStill * envelope()) body.plan.linear = body.plan.angular = Vec3::Zero();
    body.plan.number = number;
    plan.bodies.push_back(island.members[at(i)].number);
    plan.arrivals.push_back(maker_.arrival_of(i));
  }
  plan.rows = maker_.rows();
  ++report_.plans;
  report_.correction = std::max(report_.correction, maker_.largest_correction());
  plan.work = maker_.kinematic_work();
  if (plan.bodies.empty()) {
    plan.runs = false;
    free_plans_.push_back(number);
  }
}

// An island that somebody awake touches is awake.
void Resting::wake(world::World& world, Island& island, world::StepReport& report) {
  if (!world.effects.sleep) return;
  for (const Member& member : island.members) {
    world::Body& body = world.bodies[at(member.number)];
    if (!member.dynamic || !body.asleep) continue;
    body.asleep = false;
    still_[at(member.number)] = 0;
    ++report.wakes;
  }
}

// At a frame's end: an island that lies on what does not move, and whose bodies have all been slow for long enough.
void Resting::fall_asleep(world::World& world, const Island& island, world::StepReport& report) {
  const SleepSpec& sleep = *world.effects.sleep;
  bool lies = false, rests = true;
  for (const Member& member : island.members) {
    const world::Body& body = world.bodies[at(member.number)];
    if (!member.dynamic) {
      lies = true;
      rests = rests && !world.carries(member.number);
      continue;
    }
    const double speed =
        body.state.velocity.norm() + world.shapes[at(body.shape)].reach * body.state.spin.norm();
    double& still = still_[at(member.number)];
    still = speed <= sleep.speed ? still + dt_ : 0;
    rests = rests && still >= sleep.after;
  }
  if (!lies || !rests) return;
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

}  // namespace fc::resting

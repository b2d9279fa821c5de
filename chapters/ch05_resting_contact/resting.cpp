#include "ch05_resting_contact/resting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ch03_impulse_lcp/unsolved.hpp"
#include "ch05_resting_contact/sleeping.hpp"

namespace fc::resting {
namespace {

// A body that has met others so often within one frame does not bounce any more until its end: the time between bounces
// may shrink without end (compare the TC model, Luding and McNamara 1998).
constexpr int kMostBounces = 64;

// So often the plans of a body end in a frame because impulses have to change.
constexpr int kMostChanges = 8;

// A plan is halved where its paths are not clear, down to this part of a frame.
constexpr double kShortest = 1.0 / 4096;

// So are plans of piles with few rows, where paths would have to be shortened, down to this part.
constexpr int kManyRows = 100;
constexpr double kShortestOfPile = 1.0 / 512;

// A pile of so many bodies stays one until a frame whose number can be divided by this.
constexpr std::size_t kLarge = 100;
constexpr int kLookAgain = 8;

// A pile settles when its bodies are slower than this part of a margin in a frame.
constexpr double kSettles = 1.0 / 4;

// A plan that would leave less than this part of what is left of the frame takes it all.
constexpr double kNearlyAll = 0.75;

// A body in contact whose points are slower than this part of the margin in a frame stands still: below it is round-off of
// impulses that cancel. So much a body may lose in a frame, in all its instants together.
constexpr double kStill = 1e-9;
// Where impulses are so large that they cancel to no better, up to this part: paths are proved with more room.
constexpr double kMostStill = 1e-6;

// What happens at the frame's end is reported a little before it (of a frame): it belongs to this frame, whose velocities it makes.
constexpr double kBeforeEnd = 1e-9;

double reported_time(double now, double dt) {
  return std::min(now, (1 - kBeforeEnd) * dt);
}

// m, of the body's points from its centre; a ball's model reaches nowhere.
double reach_of(const world::World& world, int body) {
  return world.shapes[at(world.bodies[at(body)].shape)].reach;
}

double energy_of(const world::World& world, const RigidBody& state) {  // J
  return state.kinetic_energy() -
         (world.effects.gravity ? state.mass * world.effects.gravity->dot(state.position) : 0.0);
}

// It stands still until the frame's end.
void stop(world::World& world, int kinematic, double now, double dt, world::StepReport& report) {
  world.advance_to(kinematic, now, now);
  world.bodies[static_cast<std::size_t>(kinematic)].frozen = true;
  report.lost_time = std::max(report.lost_time, dt - now);
}

}  // namespace

Resting::Resting(const Scene& scene, world::World& world, double dt, const RestOptions& options,
                 std::unique_ptr<ContactLaw> law)
    : contacts_(world, envelope_of(scene, world, dt)),
      islands_(contacts_, world.bodies.size()),
      law_(law ? std::move(law) : std::make_unique<NormalLaw>()),
      maker_(contacts_, *law_),
      pile_planner_(contacts_, *law_),
      budget_(world.bodies.size()),
      standing_(world.bodies.size()),
      options_(options),
      frame_(dt),
      dt_(dt),
      meetings_(world.bodies.size(), 0),
      changes_(world.bodies.size(), 0),
      stilled_(world.bodies.size(), 0),
      pushed_(world.bodies.size(), 0),
      try_length_(world.bodies.size(), std::numeric_limits<double>::infinity()),
      energy_(world.bodies.size(), 0) {
  const SolverSpec usual;
  const SolverSpec& solver = world.solver;
  if (solver.method != usual.method || solver.limit != usual.limit || solver.tolerance != usual.tolerance) {
    options_.solver.chosen = solver;
    options_.most_work = std::numeric_limits<double>::infinity();  // piles are solved by sweeps of their own
  }
  options_.solver.still = kStill * envelope() / dt;
  world.rest_gap = 0.5 * envelope();
}

RestReport Resting::step(world::World& world, const world::Listeners& listeners) {
  report_ = {};
  contacts_.next_frame();
  budget_.next_frame();
  std::fill(meetings_.begin(), meetings_.end(), 0);
  std::fill(changes_.begin(), changes_.end(), 0);
  std::fill(stilled_.begin(), stilled_.end(), 0);
  std::fill(pushed_.begin(), pushed_.end(), 0);
  records_.clear();
  const std::int64_t searched = contacts_.searched();
  world::StepReport report = world::step_with(*this, world, frame_, listeners);
  if (world.effects.sleep) fall_asleep(world, islands_, frame_, report);
  report.min_gap = std::min(report.min_gap, report_.smallest_gap);
  report.max_penetration = std::max(report.max_penetration, -std::min(0.0, report_.smallest_gap));
  report_.step = report;
  report_.searched = contacts_.searched() - searched;
  report_.tangential_work += records_.tangential_work();
  if (listeners.impact) records_.report(listeners.impact);
  return report_;
}

std::vector<int> Resting::begin(world::World& world, double dt, world::StepReport& report,
                                const world::Listeners& listeners) {
  dt_ = dt;
  for (Clash clash : watch_.look(world, contacts_, dt)) {
    clash.time += world.part_start;
    report_.clashes.push_back(clash);
  }
  standing_.begin(world, envelope(), dt);
  plans_.clear();
  free_plans_.clear();
  piles_.begin(
      world.bodies.size(),
      find_piles(
          world, contacts_, dt, options_.most_work,
          [&](double arrivals, int rank) { return law_->event_work(arrivals, rank); },
          contacts_.frame() % kLookAgain == 0 ? std::vector<std::vector<int>>{} : piles_.large(kLarge)));
  Instant instant{world, 0, report, listeners};
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
    if (world.is_dynamic(body) && !world.bodies[at(body)].asleep) instant.bodies.push_back(body);
  return go_on(std::move(instant));
}

double Resting::next_end() const {
  double first = std::numeric_limits<double>::infinity();
  for (const Running& plan : plans_)
    if (plan.runs) first = std::min(first, plan.end);
  return first;
}

std::vector<int> Resting::end_plans(world::World& world, double now, world::StepReport& report,
                                    const world::Listeners& listeners) {
  Instant instant{world, now, report, listeners};
  for (const Running& plan : plans_)
    if (plan.runs && plan.end <= now)
      instant.bodies.insert(instant.bodies.end(), plan.what->bodies.begin(), plan.what->bodies.end());
  return go_on(std::move(instant));
}

std::vector<int> Resting::meet(world::World& world, int a, int b, double now, world::StepReport& report,
                               const world::Listeners& listeners) {
  Instant instant{world, now, report, listeners};
  for (const int body : {a, b}) {
    ++meetings_[at(body)];
    if (world.is_dynamic(body)) instant.bodies.push_back(body);
  }
  const auto is_in_pile = [&](int body) { return piles_.of(body) != nullptr; };
  if (std::any_of(instant.bodies.begin(), instant.bodies.end(), is_in_pile)) piles_.unite(instant.bodies);
  return go_on(std::move(instant));
}

void Resting::add_push(const lcp::Contact& contact, double impulse) {
  pushed_[at(contact.body_a)] += impulse;
  pushed_[at(contact.body_b)] += impulse;
}

// m/s: a body in contact whose points are slower stands still.
double Resting::still_speed(const world::World& world, int body) const {
  const double left = law_->left() * pushed_[at(body)] * world.bodies[at(body)].state.inverse_mass;
  return std::min(kStill * envelope() / dt_ + left, kMostStill * envelope() / dt_);
}

// These bodies, and all that they are in contact with, directly or over others.
std::vector<int> Resting::go_on(Instant instant) {
  islands_.begin(instant.now);
  piles_.begin_instant();
  for (std::size_t i = 0; i < instant.bodies.size(); ++i) {  // the list grows
    const int body = instant.bodies[i];
    if (piles_.of(body) == nullptr) {
      if (islands_.is_in_island(body)) continue;
      Island island = islands_.grow(instant.world, body, piles_.pile_of());
      join_pile(island, is_too_much(instant, island));
      if (piles_.of(body) == nullptr) go_on(instant, island);
    }
    PileList::Pile* pile = piles_.of(body);
    if (pile != nullptr && !pile->done) go_on(instant, *pile);
  }
  if (instant.now > 0) report_.correction_energy += std::max(0.0, instant.gained);
  if (instant.now >= dt_) instant.changed.clear();  // the frame is over
  return std::move(instant.changed);
}

// To go on from event to event, with an island that is no pile yet.
bool Resting::is_too_much(const Instant& instant, const Island& island) const {
  if (!std::isfinite(options_.most_work)) return false;
  return law_->event_work(0, island.rank()) > options_.most_work ||
         (instant.now < dt_ && budget_.is_spent(island));
}

// Plans end, the instant's impact law acts, and new plans begin; an island that cannot be followed becomes a pile.
void Resting::go_on(Instant& instant, Island& island) {
  const double work = instant.report.kinematic_work, before = stand(instant, island.members),
               worked = law_->work();
  wake(instant.world, island.members, instant.report);
  report_.largest_island = std::max(report_.largest_island, island.points());
  for (const IslandPair& pair : island.pairs)
    report_.smallest_gap = std::min(report_.smallest_gap, pair.contacts->gap);
  const bool solved = island.pairs.empty() || resolve(instant, island);
  set_motions(instant, island.members, before, work);
  const bool goes = instant.now >= dt_ || island.pairs.empty() || (solved && plan(instant, island));
  budget_.add(island, law_->work() - worked, law_->most_work(island.dynamic));
  if (instant.now >= dt_) budget_.forgive(island, envelope() / dt_);
  if (!goes) join_pile(island, true);
}

// All stand where they are now; the plans that moved them end. Returns the energy (J) with which they began their motions.
double Resting::stand(Instant& instant, std::span<Member> members) {
  double energy = 0;
  for (Member& member : members) {
    if (!member.dynamic) continue;
    world::Body& body = instant.world.bodies[at(member.number)];
    if (body.plan.number >= 0) end_plan(instant, body.plan.number);
    instant.world.advance_to(member.number, instant.now, instant.now);
    member.state = body.state;
    instant.changed.push_back(member.number);
    energy += energy_[at(member.number)];
  }
  return energy;
}

void Resting::set_motions(Instant& instant, std::span<const Member> members, double before, double work) {
  double gained = work - instant.report.kinematic_work - before;
  for (const Member& member : members) {
    if (!member.dynamic) continue;
    instant.world.set_motion(member.number, member.state, instant.now);
    energy_[at(member.number)] = energy_of(instant.world, member.state);
    gained += energy_[at(member.number)];
  }
  instant.gained += gained;
}

// An island that a pile has got into belongs to it; else it becomes one if it `must`, or if it has events without end.
void Resting::join_pile(const Island& island, bool must) {
  std::vector<int> bodies;
  for (const Member& member : island.members) {
    if (!member.dynamic) continue;
    bodies.push_back(member.number);
    must =
        must || piles_.of(member.number) != nullptr || meetings_[at(member.number)] > options_.most_meetings;
  }
  if (must) piles_.unite(bodies);
}

// Its bodies stand where they are now, with the velocities that they have; what its rows did until now is reported.
void Resting::end_plan(Instant& instant, int number) {
  Running& plan = plans_[at(number)];
  const double share = (instant.now - plan.start) / (plan.end - plan.start);
  const bool whole = instant.now >= plan.end;
  instant.planned = std::max(instant.planned, instant.now - plan.start);
  for (std::size_t i = 0; i < plan.what->bodies.size(); ++i) {
    const int member = plan.what->bodies[i];
    world::Body& body = instant.world.bodies[at(member)];
    instant.world.advance_to(member, instant.now, instant.now);
    body.plan = {};
    if (whole) {
      body.state.velocity += plan.what->arrivals[i].linear;
      body.state.spin += plan.what->arrivals[i].angular;
    }
    instant.bodies.push_back(member);
  }
  for (const PlannedRow& row : plan.what->rows) {
    const double end = reported_time(instant.now, dt_);
    const Vec3 acted = whole ? row.impulse : Vec3(share * row.early);
    if (acted.dot(row.contact.normal) > 0) {
      world::ImpactRecord record = record_of(row.arrives ? end : plan.start, row.contact, row.before,
                                             row.after, acted, world::ContactKind::rest);
      record.patch = row.patch;
      records_.add(record, row.key, false);
    }
    if (!whole || !(row.back.dot(row.contact.normal) > 0)) continue;
    ++instant.report.impacts;
    instant.listeners.impact(
        record_of(end, row.contact, row.before, row.after, row.back, world::ContactKind::impact));
  }
  instant.report.kinematic_work += whole ? plan.what->kinematic_work : share * plan.what->early_work;
  plan.runs = false;
  free_plans_.push_back(number);
}

// The instant's impact law; false if it could not be solved.
bool Resting::resolve(Instant& instant, Island& island) {
  const bool ends = instant.now >= dt_;  // the frame
  if (const auto known = ends ? standing_.instant(island) : nullptr) {
    report_instant(instant, *known);
    return true;
  }
  InstantOptions options;
  options.rest_speed = envelope() / dt_;
  options.time = reported_time(instant.now, dt_);
  options.guess = instant.planned;
  options.bounces = [&](int body) { return meetings_[at(body)] < kMostBounces; };
  options.solver = options_.solver;
  std::vector<Member> before;
  if (ends) before = island.members;
  const InstantResult result = resolve_instant(instant.world, island, envelope(), *law_, options);
  if (!result.solved && options_.solver.chosen)
    throw lcp::unsolved(instant.world.solver, result.status, result.steps, result.residual);
  if (!result.solved) return false;
  instant.report.solves += result.solves;
  report_instant(instant, result);
  for (const world::ImpactRecord& record : result.records)
    add_push(record.contact, record.impulse.impulse + record.tangential.norm());
  for (Member& member :
       island.members) {  // what is left of a velocity in contact that does not move the body
    if (!member.dynamic) continue;
    const double reach = reach_of(instant.world, member.number);
    const double speed = member.state.velocity.norm() + reach * member.state.spin.norm();
    double& stilled = stilled_[at(member.number)];
    if (stilled + speed >= still_speed(instant.world, member.number)) continue;
    stilled += speed;
    member.state.velocity = member.state.spin = Vec3::Zero();
  }
  if (ends && !result.impact) standing_.keep(before, island, result);
  if (result.impact && instant.listeners.instant) {
    for (const Member& member : island.members)
      if (member.dynamic) instant.world.set_motion(member.number, member.state, instant.now);
    instant.listeners.instant(instant.world, instant.now);
  }
  return true;
}

void Resting::report_instant(Instant& instant, const InstantResult& result) {
  world::StepReport& report = instant.report;
  report.contacts += result.contacts;
  report.lcp_rows += result.rows;
  report.lcp_residual = std::max(report.lcp_residual, result.residual);
  report.kinematic_work += result.kinematic_work;
  report.energy_gain = std::max(report.energy_gain, result.energy_gain);
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    const world::ImpactRecord& record = result.records[i];
    const bool impact = record.kind == world::ContactKind::impact;
    report.impacts += impact;
    if (impact)
      report_.tangential_work +=
          std::min(0.0, 0.5 * record.tangential.dot(record.slip_before + record.slip_after));
    else
      records_.add(record, result.keys[i], true);
    if (impact && instant.listeners.impact) instant.listeners.impact(record);
  }
}

// A plan for the bodies of the island that are in contact, as long as their paths can be proved, at most to the frame's end;
// false if there is none.
bool Resting::plan(Instant& instant, Island& island) {
  if (const auto known = standing_.plan(island, dt_ - instant.now)) {
    start(instant, known, dt_);
    return true;
  }
  for (const IslandPair& pair : island.pairs)
    for (ContactPoint& point : pair.contacts->points) point.lasts = false;
  const double left = dt_ - instant.now;
  double length = left;
  bool may_change = true;
  for (const Member& member : island.members) {
    if (!member.dynamic) continue;
    length = std::min(length, try_length_[at(member.number)]);
    may_change = may_change && changes_[at(member.number)] < kMostChanges;
  }
  if (length > kNearlyAll * left) length = left;
  using Result = PlanMaker::Result;
  for (bool shortened = false;;) {
    const Result result = maker_.make(instant.world, island, instant.now, length,
                                      {options_.solver, envelope() / dt_, may_change});
    report_.checked += maker_.checked();
    instant.report.solves += maker_.solves();
    instant.report.lcp_residual = std::max(instant.report.lcp_residual, maker_.worst_residual());
    if (result == Result::proved) {
      for (const Member& member : island.members)
        if (member.dynamic) try_length_[at(member.number)] = shortened ? length : 2 * length;
      break;
    }
    if (result == Result::unsolved && options_.solver.chosen)
      throw lcp::unsolved(instant.world.solver, maker_.status(), maker_.steps(), maker_.worst_residual());
    shortened = shortened || result != Result::changes;
    if (result == Result::changes)
      for (const Member& member : island.members) ++changes_[at(member.number)];
    const bool meets =
        (result == Result::meets || result == Result::changes) && maker_.meeting() > kShortest * dt_;
    if (result == Result::unsolved || (!meets && length < kShortest * dt_)) return false;
    length = meets ? std::min(maker_.meeting(), 0.999 * length) : 0.5 * length;
  }
  const auto planned = std::make_shared<const Planned>(maker_.take());
  if (start(instant, planned, length == left ? dt_ : instant.now + length))
    standing_.keep(island, length, planned);
  return true;
}

// Whether these bodies nearly stand, on the whole. rest_speed: m/s, a margin in a frame.
static bool settles(std::span<const Member> members, double rest_speed) {
  double energy = 0, mass = 0;
  for (const Member& member : members) {
    energy += member.state.kinetic_energy();
    mass += member.state.mass;
  }
  return energy < 0.5 * mass * std::pow(kSettles * rest_speed, 2);
}

// A pile has no impacts of its own, only plans: one in a frame while it is calm, else two; and more, if it is so small that shorter
// plans cost less than paths that are shortened.
void Resting::go_on(Instant& instant, PileList::Pile& pile) {
  pile.done = true;
  std::vector<Member> members;
  for (const int body : pile.bodies) members.push_back({body, {}, true});
  const double work = instant.report.kinematic_work, before = stand(instant, members);
  wake(instant.world, members, instant.report);
  set_motions(instant, members, before, work);
  if (instant.now >= dt_) return;
  const bool first = instant.now < (0.5 - kShortest) * dt_;
  bool whole = first && piles_.is_calm(pile);
  double end = first && !whole ? 0.5 * dt_ : dt_, left = end - instant.now;
  PileOptions options;
  options.frame = dt_;
  options.sweeps = options_.sweeps;
  options.visits = options_.visits;
  options.report_rows = static_cast<bool>(instant.listeners.impact);
  options.settles = settles(members, contacts_.margin() / dt_);
  Planned planned;
  double length = pile.length > kNearlyAll * left ? left : pile.length;
  for (bool stopped = false;;) {
    planned = pile_planner_.make(instant.world, members, instant.now, length, options);
    report_.checked += pile_planner_.checked();
    report_.sweeps += pile_planner_.sweeps();
    const bool is_clear = pile_planner_.blocked().empty() && pile_planner_.shortened() == 0;
    if (!is_clear) piles_.was_shortened(pile);
    if (std::exchange(whole, false) && !(is_clear && !pile_planner_.gains())) {
      end = 0.5 * dt_;
      length = left = end - instant.now;
      continue;
    }
    const bool blocked = !pile_planner_.blocked().empty() && !stopped;
    const bool is_small = blocked || pile_planner_.rows() <= kManyRows;
    const bool is_short = pile_planner_.shortened() > 0 && !pile.jammed;
    if (is_small && (is_short || pile_planner_.gains()) &&
        length > (blocked ? kShortest : kShortestOfPile) * dt_) {
      length *= 0.5;
    } else if (blocked) {
      for (const int body : pile_planner_.blocked())
        stop(instant.world, body, instant.now, dt_, instant.report);
      stopped = true;
    } else if (is_short && stopped) {
      pile.jammed = true;
      length = left;
    } else {
      break;
    }
  }
  pile.length = 2 * length;
  report_.shortened += pile_planner_.shortened();
  report_.lost_impulse += pile_planner_.lost_impulse();
  report_.largest_island = std::max(report_.largest_island, pile_planner_.rows());
  report_.smallest_gap = std::min(report_.smallest_gap, pile_planner_.smallest_gap());
  instant.report.lcp_residual = std::max(instant.report.lcp_residual, pile_planner_.residual());
  instant.report.contacts += pile_planner_.rows();
  ++instant.report.solves;
  start(instant, std::make_shared<const Planned>(std::move(planned)),
        length == left ? end : instant.now + length);
}

// Whether nobody moves by it.
bool Resting::start(Instant& instant, const std::shared_ptr<const Planned>& planned, double end) {
  ++report_.plans;
  report_.resting += planned->pushing;
  report_.correction = std::max(report_.correction, planned->correction);
  if (planned->bodies.empty()) return false;
  int number = static_cast<int>(plans_.size());
  if (free_plans_.empty()) {
    plans_.emplace_back();
  } else {
    number = free_plans_.back();
    free_plans_.pop_back();
  }
  for (const PlannedRow& row : planned->rows) add_push(row.contact, row.impulse.norm());
  bool stands = true;
  for (std::size_t i = 0; i < planned->bodies.size(); ++i) {
    world::Body& body = instant.world.bodies[at(planned->bodies[i])];
    body.plan = planned->motions[i];
    body.plan.number = number;
    const double speed =
        body.plan.linear.norm() + reach_of(instant.world, planned->bodies[i]) * body.plan.angular.norm();
    if (speed < (planned->correction > kStill * envelope() ? kStill * envelope() / dt_
                                                           : still_speed(instant.world, planned->bodies[i])))
      body.plan.linear = body.plan.angular = Vec3::Zero();
    else
      stands = false;
  }
  plans_[at(number)] = {true, instant.now, end, planned};
  return stands;
}

}  // namespace fc::resting

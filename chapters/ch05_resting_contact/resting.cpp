#include "ch05_resting_contact/resting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ch03_impulse_lcp/unsolved.hpp"
#include "ch05_resting_contact/sleeping.hpp"

namespace fc::resting {
namespace {

// A body that has met others this often within one frame does not bounce any more until its end: the time between
// bounces may shrink without end (compare the TC model, Luding and McNamara 1998).
constexpr int kMostBounces = 64;

// Plans of piles with few rows are halved where paths would have to be shortened, down to this share of a frame.
constexpr int kManyRows = 100;
constexpr double kShortestOfPile = 1.0 / 512;

// A pile is slow if its bodies go no farther in a frame than this, in margins.
constexpr double kSlow = 4;

// A pile's plan for the whole frame may shorten the paths of this share of its bodies.
constexpr double kFew = 1.0 / 64;

// A pile of this size is kept without a search. Every time this number of frames has passed, all piles are searched
// again.
constexpr std::size_t kLarge = 100;
constexpr int kLookAgain = 8;

double energy_of(const world::World& world, const RigidBody& state) {  // J
  return state.kinetic_energy() -
         (world.effects.gravity ? state.mass * world.effects.gravity->dot(state.position) : 0.0);
}

double kinetic(std::span<const Member> members) {  // J
  double sum = 0;
  for (const Member& member : members)
    if (member.dynamic) sum += member.state.kinetic_energy();
  return sum;
}

// The body stands still until the frame's end.
void stop(world::World& world, int kinematic, double now, double dt, world::StepReport& report) {
  world.advance_to(kinematic, now, now);
  world.bodies[static_cast<std::size_t>(kinematic)].frozen = true;
  report.lost_time = std::max(report.lost_time, dt - now);
}

}  // namespace

Resting::Resting(const Scene& scene, world::World& world, double dt, const RestOptions& options,
                 std::unique_ptr<ContactLaw> law)
    : options_(options),
      frame_(dt),
      dt_(dt),
      contacts_(world, envelope_of(scene, world, dt)),
      islands_(contacts_, world.bodies.size()),
      law_(law ? std::move(law) : std::make_unique<NormalLaw>()),
      maker_(contacts_, *law_, world.bodies.size()),
      pile_planner_(contacts_, *law_),
      piles_(world.bodies.size()),
      standing_(*law_, contacts_.margin(), world.bodies.size()),
      meetings_(world.bodies.size(), 0),
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

void Resting::take_over(const Resting& before, bool same_rules) {
  if (before.envelope() != envelope()) return;
  contacts_.take_over(before.contacts_);
  if (same_rules && before.frame_ == frame_) standing_.take_over(before.standing_);
}

RestReport Resting::step(world::World& world, const world::Listeners& listeners) {
  report_ = {};
  records_ = {};
  contacts_.next_frame();
  piles_.next_frame();
  standing_.next_frame();
  std::fill(meetings_.begin(), meetings_.end(), 0);
  maker_.next_frame();
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
  standing_.begin(world, dt);
  plans_ = {};
  piles_.begin(find_piles(
      world, contacts_, dt, options_.most_work,
      [&](double arrivals, int rank) { return law_->event_work(arrivals, rank); },
      contacts_.frame() % kLookAgain == 0 ? std::vector<std::vector<int>>{} : piles_.large(kLarge)));
  Instant instant{world, 0, report, listeners};
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body)
    if (world.is_dynamic(body) && !world.bodies[at(body)].asleep) instant.bodies.push_back(body);
  return go_on(std::move(instant));
}

double Resting::next_end() const {
  return plans_.next_end();
}

std::vector<int> Resting::end_plans(world::World& world, double now, world::StepReport& report,
                                    const world::Listeners& listeners) {
  return go_on({world, now, report, listeners, plans_.bodies_until(now)});
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

// These bodies, and all that they are in contact with, directly or through others, go on.
std::vector<int> Resting::go_on(Instant instant) {
  islands_.begin(instant.now);
  piles_.begin_instant();
  for (std::size_t i = 0; i < instant.bodies.size(); ++i) {  // the list grows
    const int body = instant.bodies[i];
    if (piles_.of(body) == nullptr) {
      if (islands_.is_in_island(body)) continue;
      Island island = grow(instant.world, body);
      if (is_pile(instant, island) || !go_on(instant, island)) {
        std::vector<int> bodies;
        for (const Member& member : island.members)
          if (member.dynamic) bodies.push_back(member.number);
        piles_.unite(bodies);
      }
    }
    PileList::Pile* pile = piles_.of(body);
    if (pile != nullptr && !pile->done) go_on(instant, *pile);
  }
  if (instant.now > 0) report_.correction_energy += std::max(0.0, instant.gained);
  report_.plan_gain += std::max(0.0, instant.on_plans);
  report_.plan_loss += std::min(0.0, instant.on_plans);
  if (instant.now >= dt_) instant.changed.clear();  // the frame is over
  return std::move(instant.changed);
}

Island Resting::grow(const world::World& world, int body) {
  const TimeInto time(report_.times.contacts_ns);
  return islands_.grow(world, body, piles_.pile_of());
}

// Whether the island contains bodies of a pile, or stepping it from event to event would take too much work.
bool Resting::is_pile(const Instant& instant, const Island& island) {
  const auto cannot_go = [&](const Member& member) {
    return member.dynamic &&
           (piles_.of(member.number) != nullptr || meetings_[at(member.number)] > options_.most_meetings);
  };
  if (std::any_of(island.members.begin(), island.members.end(), cannot_go)) return true;
  if (!std::isfinite(options_.most_work)) return false;
  return law_->event_work(0, island.rank()) > options_.most_work ||
         (instant.now < dt_ && piles_.is_spent(island));
}

// Plans end, the instant's impact law acts, and new plans begin. False if the island cannot be stepped like this.
bool Resting::go_on(Instant& instant, Island& island) {
  const double work = instant.report.kinematic_work, before = stand(instant, island.members),
               worked = law_->work();
  wake(instant.world, island.members, instant.report);
  report_.largest_island = std::max(report_.largest_island, island.points());
  for (const IslandPair& pair : island.pairs)
    report_.smallest_gap = std::min(report_.smallest_gap, pair.contacts->gap);
  const auto without_works = [&] {
    return kinetic(island.members) - instant.report.kinematic_work - records_.tangential_work();
  };
  const double unresolved = without_works();
  const int impacts = instant.report.impacts;
  const bool solved = island.pairs.empty() || resolve(instant, island);
  // Without an impact, an instant only takes back what the plans that end here have borrowed: the other half of their pushes.
  (instant.report.impacts > impacts ? report_.impact_energy : instant.on_plans) +=
      without_works() - unresolved;
  set_motions(instant, island.members, before, work);
  const bool goes = instant.now >= dt_ || island.pairs.empty() || (solved && plan(instant, island));
  const double rest_speed = instant.now >= dt_ ? envelope() / dt_ : 0;
  piles_.add_work(island, law_->work() - worked, law_->most_work(island.dynamic), rest_speed);
  return goes;
}

// Ends the plans that move the members, at their present poses. Returns the energy (J) with which they began their
// motions.
double Resting::stand(Instant& instant, std::span<Member> members) {
  double energy = 0;
  for (Member& member : members) {
    if (!member.dynamic) continue;
    world::Body& body = instant.world.bodies[at(member.number)];
    if (body.plan.number >= 0) {
      const RunningPlan plan = plans_.end(instant.world, body.plan.number, instant.now);
      instant.planned = std::max(instant.planned, instant.now - plan.start);
      instant.bodies.insert(instant.bodies.end(), plan.what->bodies.begin(), plan.what->bodies.end());
      const double work = instant.report.kinematic_work + records_.tangential_work();
      records_.add(instant, plan, dt_);
      for (const int body_of_plan : plan.what->bodies)
        instant.on_plans += energy_of(instant.world, instant.world.bodies[at(body_of_plan)].state) -
                            energy_[at(body_of_plan)];
      instant.on_plans -= instant.report.kinematic_work + records_.tangential_work() - work;
    }
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

// The instant's impact law; false if it could not be solved.
bool Resting::resolve(Instant& instant, Island& island) {
  const bool ends = instant.now >= dt_;  // the frame
  if (const auto known = ends ? standing_.instant(island) : nullptr) {
    records_.add(instant, *known);
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
  const InstantResult result = [&] {
    const TimeInto time(report_.times.solver_ns), of_instants(report_.times.instants_ns);
    return resolve_instant(instant.world, island, envelope(), *law_, options);
  }();
  if (!result.solved && options_.solver.chosen)
    throw lcp::unsolved(instant.world.solver, result.status, result.steps, result.residual);
  if (!result.solved) return false;
  instant.report.solves += result.solves;
  records_.add(instant, result);
  for (const world::ImpactRecord& record : result.records)
    standing_.add(record.contact, record.impulse.impulse + record.tangential.norm());
  standing_.stop(instant.world, island.members);
  if (ends && !result.impact) standing_.keep(before, island, result);
  if (result.impact && instant.listeners.instant) {
    for (const Member& member : island.members)
      if (member.dynamic) instant.world.set_motion(member.number, member.state, instant.now);
    instant.listeners.instant(instant.world, instant.now);
  }
  return true;
}

// A plan for the island; false if there is none.
bool Resting::plan(Instant& instant, const Island& island) {
  const double left = dt_ - instant.now;
  if (const auto known = standing_.plan(island, left)) {
    start(instant, known, dt_);
    return true;
  }
  const auto planned = maker_.make(instant.world, island, instant.now, dt_, options_.solver, instant.report);
  report_.checked += maker_.checked();
  report_.times.add(maker_.times());
  if (!planned) return false;
  const double length = maker_.length();
  if (start(instant, planned, length == left ? dt_ : instant.now + length))
    standing_.keep(island, length, planned);
  return true;
}

// A pile has no impacts of its own, only plans: one in a frame while it is calm and slow, else two; and more if it is
// so small that shorter plans cost less than shortened paths.
void Resting::go_on(Instant& instant, PileList::Pile& pile) {
  pile.done = true;
  std::vector<Member> members;
  for (const int body : pile.bodies) members.push_back({body, {}, true});
  const double work = instant.report.kinematic_work, before = stand(instant, members);
  wake(instant.world, members, instant.report);
  set_motions(instant, members, before, work);
  if (instant.now >= dt_) return;
  const bool first = instant.now < (0.5 - kShortest) * dt_;
  bool whole = first && piles_.is_calm(pile) && are_slow(members, kSlow * envelope() / dt_);
  double end = first && !whole ? 0.5 * dt_ : dt_, left = end - instant.now;
  PileOptions options;
  options.frame = dt_;
  options.sweeps = options_.sweeps;
  options.visits = options_.visits;
  options.settling_visits = options_.settling_visits;
  options.report_rows = static_cast<bool>(instant.listeners.impact);
  Planned planned;
  double length = pile.length > kNearlyAll * left ? left : pile.length;
  for (bool stopped = false;;) {
    planned = pile_planner_.make(instant.world, members, instant.now, length, options);
    report_.checked += pile_planner_.checked();
    report_.times.add(pile_planner_.times());
    report_.sweeps += pile_planner_.sweeps();
    const bool is_clear = pile_planner_.blocked().empty() && pile_planner_.shortened() == 0;
    if (!is_clear) piles_.was_shortened(pile);
    const bool is_enough = pile_planner_.blocked().empty() && !pile_planner_.gains() &&
                           pile_planner_.shortened() <= kFew * static_cast<double>(pile.bodies.size());
    if (std::exchange(whole, false) && !is_enough) {
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

// Starts a plan. Returns whether no body moves by it.
bool Resting::start(Instant& instant, const std::shared_ptr<const Planned>& planned, double end) {
  ++report_.plans;
  report_.resting += planned->pushing;
  report_.correction = std::max(report_.correction, planned->correction);
  if (planned->bodies.empty()) return false;
  for (const PlannedRow& row : planned->rows) standing_.add(row.contact, row.impulse.norm());
  plans_.start(instant.world, {instant.now, end, planned});
  return standing_.stop(instant.world, *planned);
}

}  // namespace fc::resting

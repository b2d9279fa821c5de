#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "ch03_impulse_lcp/unsolved.hpp"
#include "ch04_multibody_stepping/contact_search.hpp"
#include "ch04_multibody_stepping/sensors.hpp"
#include "ch04_multibody_stepping/sleep.hpp"
#include "ch04_multibody_stepping/world.hpp"
#include "common/stopwatch.hpp"

namespace fc::world {
namespace {

// What an impact must not change, summed over the bodies of an island, and the sizes to which round-off is compared.
struct Totals {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double linear_size = 0, angular_size = 0, kinetic = 0;

  explicit Totals(std::span<const RigidBody> bodies) {
    for (const RigidBody& body : bodies) {
      if (body.is_static()) continue;
      const Vec3 own = body.inertia_world() * body.spin, orbit = body.position.cross(body.momentum());
      linear += body.momentum();
      angular += orbit + own;
      linear_size += body.momentum().norm();
      angular_size += body.position.norm() * body.momentum().norm() + own.norm();
      kinetic += body.kinetic_energy();
    }
  }
};

// The bodies of an island with their states at one time, and its contacts, which name bodies by their places in that
// list: first the bodies that can move, then the static ones that they touch.
struct Local {
  std::vector<int> numbers;
  std::vector<RigidBody> states;
  std::vector<lcp::Contact> contacts;

  Local(const World& world, const Island& island, double now)
      : numbers(island.bodies), contacts(island.contacts) {
    for (lcp::Contact& contact : contacts) {
      contact.body_a = place_of(contact.body_a);
      contact.body_b = place_of(contact.body_b);
    }
    for (const int body : numbers) states.push_back(world.state_at(body, now));
  }
  int place_of(int body) {
    const auto found = std::find(numbers.begin(), numbers.end(), body);
    if (found == numbers.end()) numbers.push_back(body);
    return static_cast<int>(std::find(numbers.begin(), numbers.end(), body) - numbers.begin());
  }
};

// The state of one step from contact to contact: the world, the frame and the report. The loop sees it as a Frame.
class Stepper final : public clear::Frame {
 public:
  Stepper(World& world, double dt, StepReport& report, const Listeners& listeners)
      : world_(world), schedule_(world.schedule), dt_(dt), report_(report), listeners_(listeners) {}

  // Opens the pairs whose swept boxes overlap in the frame, and queries each for its next contact.
  void begin_frame(Planner* planner) {
    begin_schedule();
    if (planner != nullptr)
      for (const int body : planner->begin(world_, dt_, report_, listeners_))
        schedule_.replace(body, world_.swept_bounds(body, 0, dt_));
    for (const auto& [a, b] : near_pairs()) open(a, b, 0);
  }

  std::optional<clear::Event> earliest() override {
    using Kind = clear::Event::Kind;
    const int number = schedule_.next();
    if (number < 0) return std::nullopt;
    const Pair& pair = schedule_.pair(number);
    const Kind contact = is_sensor_pair(world_, pair.a, pair.b) ? Kind::sensed : Kind::contact;
    return clear::Event{pair.contact ? contact : Kind::clear, pair.time, pair.a, pair.b, pair.stalled};
  }

  void query(int a, int b, double now) override {
    const int number = schedule_.find(a, b);
    if (number >= 0) query(number, now);  // else the two do not come near each other
  }

  void report(int a, int b, double now) override { sight(a, b, now); }

  bool is_stalled(int a, int b) const override {
    const int number = schedule_.find(a, b);
    if (number < 0) return false;  // the two do not come near each other
    return schedule_.pair(number).stalled;
  }

  std::span<const int> solve(int a, int b, double now) override {
    island_ = touching_island(world_, a, b, now, report_);
    solve_island(now);
    if (listeners_.instant) listeners_.instant(world_, now);
    return changed_;
  }

  // An island that touches nothing fixed goes on with its centre of mass. Any other stays where it is, and so do the
  // kinematic bodies that move into it: they would go through it.
  std::span<const int> freeze(double now) override {
    changed_ = island_.bodies;
    const bool free = is_free(island_);
    bool lies = !free;  // it rests on nothing that moves
    if (!free)
      for (const lcp::Contact& contact : island_.contacts) stop_pushers(contact, now, changed_, lies);
    std::erase_if(changed_,
                  [&](int body) { return world_.bodies[body].asleep || is_still(world_.bodies[body]); });
    Vec3 momentum = Vec3::Zero();
    double mass = 0;
    for (const int body : changed_) {
      if (world_.bodies[body].frozen) lose(now - world_.bodies[body].time);
      world_.advance_to(body, now, now);
      momentum += world_.bodies[body].state.momentum();
      mass += world_.bodies[body].state.mass;
    }
    for (const int body : changed_) {
      Body& b = world_.bodies[body];
      b.frozen = true;
      b.lies = lies;
      b.group = free ? island_.bodies.front() : -1;
      b.group_velocity = free ? Vec3(momentum / mass) : Vec3(Vec3::Zero());
    }
    return changed_;
  }

  // Queries a pair with a sensor, and reports a new sighting: contacts are reported, not resolved. Returns whether they
  // touch.
  bool sight(int a, int b, double now) {
    bool touching = false;
    const std::optional<Sighting> sighting = look(world_, a, b, now, touching);
    if (!sighting) return touching;
    ++report_.sightings;
    if (listeners_.sighting) listeners_.sighting(*sighting);
    return touching;
  }

  void renew(std::span<const int> bodies, double now) override {
    std::vector<Bounds> boxes;
    for (const int body : bodies) {
      boxes.push_back(world_.swept_bounds(body, now, dt_));
      schedule_.replace(body, boxes.back());
    }
    done_.resize(world_.bodies.size(), 0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      done_[static_cast<std::size_t>(bodies[i])] =
          1;  // their pairs with this body are open already; or it is this body
      open_pairs(bodies[i], boxes[i], now,
                 [&](int other) { return done_[static_cast<std::size_t>(other)] != 0; });
    }
    for (const int body : bodies) done_[static_cast<std::size_t>(body)] = 0;
  }

 private:
  void query(int number, double now) {
    Pair& pair = schedule_.pair(number);
    std::optional<double> gap;  // known for the pairs that touched at this instant
    if (now == solved_at_)
      for (const PairGap& known : solved_)
        if (known.a == pair.a && known.b == pair.b) gap = known.gap;
    find_next_contact(world_, pair, now, dt_, gap, report_);
    schedule_.answered(number, dt_);
  }

  void solve_island(double now);

  void begin_schedule() {
    const TimeInto time(report_.broad_ns);
    std::vector<Bounds> boxes;
    boxes.reserve(world_.bodies.size());
    for (int body = 0; body < static_cast<int>(world_.bodies.size()); ++body)
      boxes.push_back(world_.swept_bounds(body, 0, dt_));
    schedule_.begin(boxes);
  }

  // The pairs to be queried in this frame, in the bodies' order, in which the tree does not return them.
  std::vector<std::pair<int, int>> near_pairs() const {
    const TimeInto time(report_.broad_ns);
    std::vector<std::pair<int, int>> pairs;
    schedule_.overlapping_pairs([&](int a, int b) {
      if (world_.may_meet(a, b)) pairs.emplace_back(std::min(a, b), std::max(a, b));
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  // Frozen in place, not as part of a group that goes on.
  static bool is_still(const Body& body) { return body.frozen && body.group < 0; }
  void lose(double time) { report_.lost_time = std::max(report_.lost_time, time); }

  // Whether everything that the island touches is part of it and free to move.
  bool is_free(const Island& island) const {
    for (const lcp::Contact& contact : island.contacts)
      for (const int number : {contact.body_a, contact.body_b}) {
        const Body& body = world_.bodies[number];
        if (!world_.is_dynamic(number) || body.state.free_moves != Vec3::Ones() || body.asleep ||
            is_still(body))
          return false;
      }
    return true;
  }

  // Adds the kinematic bodies that move into a contact; `lies` becomes false if one moves at the contact at all.
  void stop_pushers(const lcp::Contact& contact, double now, std::vector<int>& stopped, bool& lies) const {
    for (const int body : {contact.body_a, contact.body_b}) {
      if (!world_.is_moving_kinematic(body)) continue;
      lies = false;
      const double towards_b = contact.normal.dot(world_.state_at(body, now).velocity_at(contact.point));
      const bool into = body == contact.body_a ? towards_b > 0 : towards_b < 0;
      if (into && std::find(stopped.begin(), stopped.end(), body) == stopped.end()) stopped.push_back(body);
    }
  }

  void open(int a, int b, double now) {
    ++report_.pairs;
    if (is_sensor_pair(world_, a, b) && sight(a, b, now))
      return;  // no event until one of them begins a new motion
    query(schedule_.open(a, b), now);
  }

  // Opens and queries the pairs of a body with all bodies whose boxes overlap its own, except those for which `skip` is
  // true.
  template <class Skip>
  void open_pairs(int body, const Bounds& box, double now, Skip&& skip) {
    others_.clear();
    schedule_.overlapping(box, [&](int other) {
      if (!skip(other) && world_.may_meet(body, other)) others_.push_back(other);
    });
    std::sort(others_.begin(), others_.end());
    for (const int other : others_) open(body, other, now);
  }

  World& world_;
  Schedule& schedule_;
  double dt_;
  StepReport& report_;
  const Listeners& listeners_;
  std::vector<int> others_;
  std::vector<char> done_;       // of each body, in renew()
  std::vector<int> changed_;     // bodies with new motions, since the last instant
  Island island_;                // of the last instant
  std::vector<PairGap> solved_;  // the pairs that touched at the last instant, and its time
  double solved_at_ = -1;
};

void Stepper::solve_island(double now) {
  const Stopwatch watch;
  const Island& island = island_;
  Local local(world_, island, now);
  const Totals before(local.states);
  const lcp::ImpactResult impact = lcp::resolve_impact(local.states, local.contacts, world_.impact);
  if (impact.status != lcp::Status::solved)
    throw lcp::unsolved(world_.solver, impact.status, impact.failed_pivots, impact.failed_residual);
  const Totals after(local.states);
  report_.contacts += static_cast<int>(island.contacts.size()) * impact.solves;
  report_.impacts += static_cast<int>(impact.impulses.size());
  report_.lcp_rows += impact.rows;
  report_.solves += impact.solves;
  report_.lcp_residual = std::max(report_.lcp_residual, impact.worst_residual);
  report_.kinematic_work += impact.kinematic_work;
  report_.energy_gain = std::max(report_.energy_gain, after.kinetic - before.kinetic - impact.kinematic_work);
  report_.energy_error =
      std::max(report_.energy_error, std::abs(after.kinetic - before.kinetic - impact.energy_identity));
  // No static body takes part, and no body has fixed degrees of freedom.
  const bool free = local.numbers.size() == island.bodies.size() &&
                    std::none_of(local.states.begin(), local.states.end(),
                                 [](const RigidBody& body) { return body.is_guided(); });
  if (free && before.linear_size > 0)
    report_.momentum_error =
        std::max({report_.momentum_error, (after.linear - before.linear).norm() / before.linear_size,
                  (after.angular - before.angular).norm() / before.angular_size});
  report_.lcp_ns += watch.ns();
  solved_ = island.gaps;
  solved_at_ = now;

  changed_.clear();
  if (!impact.impulses.empty())
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
      const Body& body = world_.bodies[island.bodies[i]];
      const RigidBody& state = local.states[i];
      const bool same =
          is_still(body) && state.velocity == body.state.velocity && state.spin == body.state.spin;
      if (same) continue;  // a frozen body that was not hit stays frozen
      if (body.frozen) lose(now - body.time);
      changed_.push_back(island.bodies[i]);
    }
  if (world_.effects.sleep) wake(world_, now, changed_, report_);
  for (const int body : changed_) {
    const auto place = std::find(island.bodies.begin(), island.bodies.end(), body) - island.bodies.begin();
    const bool hit = place < static_cast<std::ptrdiff_t>(island.bodies.size());
    world_.set_motion(body, hit ? local.states[static_cast<std::size_t>(place)] : world_.state_at(body, now),
                      now);
  }
  if (listeners_.impact)
    for (const lcp::Impulse& impulse : impact.impulses)
      listeners_.impact({now, island.contacts[impulse.contact], impulse});
}

// The loop with a planner, which decides what becomes of bodies in contact: its plans end, too, and nothing is frozen.
void run_planned(Stepper& stepper, Planner& planner, World& world, double dt, StepReport& report,
                 const Listeners& listeners) {
  using Kind = clear::Event::Kind;
  while (true) {
    if (const double end = planner.next_end(); end <= std::min(world.schedule.next_time(), dt)) {
      stepper.renew(planner.end_plans(world, end, report, listeners), end);
      continue;
    }
    const std::optional<clear::Event> event = stepper.earliest();
    if (!event) return;
    const auto [kind, now, a, b, stalled] = *event;
    if (kind == Kind::clear) stepper.query(a, b, now);
    if (kind == Kind::sensed) stepper.report(a, b, now);
    if (kind == Kind::contact) stepper.renew(planner.meet(world, a, b, now, report, listeners), now);
  }
}

StepReport step(World& world, double dt, const Listeners& listeners, Planner* planner);

// A frame that is divided where bodies with a path begin new motions.
StepReport step_in_parts(World& world, double dt, const Listeners& listeners, Planner* planner) {
  StepReport all;
  all.min_gap = std::numeric_limits<double>::infinity();
  double length = 0;
  for (double start = 0; start < dt; start += length) {
    length = until_next_row(world, dt - start);
    world.part_start = start;
    const StepReport part = step(world, length, from(start, listeners), planner);
    add(part, all);
    all.step_ns += part.step_ns;
    all.ccd_ns += part.ccd_ns;
  }
  world.part_start = 0;
  return all;
}

StepReport step(World& world, double dt, const Listeners& listeners, Planner* planner) {
  if (!(dt > 0 && std::isfinite(dt)))
    throw std::invalid_argument(fmt::format("step: dt is {} s; it must be finite and > 0", dt));
  if (world.effects.paths) {
    if (until_next_row(world, dt) < dt) return step_in_parts(world, dt, listeners, planner);
    follow_paths(world, dt);
  }
  const Stopwatch watch;
  StepReport report;
  report.min_gap = std::numeric_limits<double>::infinity();

  // ANCHOR: step
  Stepper stepper(world, dt, report, listeners);
  stepper.begin_frame(planner);  // pairs whose swept boxes overlap; each is queried
  if (planner == nullptr)
    world.event_loop(stepper);
  else
    run_planned(stepper, *planner, world, dt, report, listeners);
  // ANCHOR_END: step

  if (world.effects.sleep && planner == nullptr) fall_asleep(world, dt, report);
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body) {
    Body& b = world.bodies[body];
    if (b.frozen) report.lost_time = std::max(report.lost_time, dt - b.time);
    world.advance_to(body, dt, 0);
    b.was_frozen = b.frozen && b.group < 0;  // a group went on during the frame
    b.frozen = false;
    b.group = -1;
    b.group_velocity = Vec3::Zero();
  }
  report.step_ns = watch.ns();
  report.ccd_ns = report.step_ns - report.lcp_ns;
  return report;
}

}  // namespace

StepReport step(World& world, double dt, const Listeners& listeners) {
  return step(world, dt, listeners, nullptr);
}

StepReport step_with(Planner& planner, World& world, double dt, const Listeners& listeners) {
  return step(world, dt, listeners, &planner);
}

}  // namespace fc::world

#include "ch05_resting_contact/resting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "ch03_impulse_lcp/unsolved.hpp"
#include "common/stopwatch.hpp"

namespace fc::resting {
namespace {

// A contact with a gap of less than so many tolerances has no way left.
constexpr double kNoWay = 2;

// A body in contact whose points are slower than this part of the envelope in a frame stands still: below it
// is round-off of impulses that cancel.
constexpr double kStill = 1e-9;

}  // namespace

Resting::Resting(const Scene& scene, world::World& world, double dt, const RestOptions& options)
    : shell_(world, envelope_of(scene, world)),
      options_(options),
      frame_(dt),
      dt_(dt),
      is_far_(world.bodies.size(), 0),
      still_(world.bodies.size(), 0),
      place_(world.bodies.size(), -1) {
  const SolverSpec usual;
  const SolverSpec& solver = world.solver;
  if (solver.method != usual.method || solver.limit != usual.limit || solver.tolerance != usual.tolerance) {
    options_.small.chosen = solver;
    options_.crowd = std::numeric_limits<int>::max();  // crowds are solved by sweeps of their own
  }
  world.touch = shell_.envelope();
  world.reserve = 0.5 * shell_.envelope();
}

RestReport Resting::step(world::World& world, const world::Listeners& listeners) {
  const Stopwatch watch;
  RestReport report;
  report.step.min_gap = report.smallest_gap = std::numeric_limits<double>::infinity();
  const int level = std::max(0, halvings_ - 1), parts = 1 << level;  // half of what the last frame needed
  halvings_ = level;
  was_far_.swap(is_far_);
  is_far_.assign(world.bodies.size(), 0);
  for (int part = 0; part < parts; ++part) {
    double start = frame_ / parts * part, left = frame_ / parts;
    // Cut where a body with a path takes a new course.
    for (double length = left; left > 0; start += length, left -= length) {
      if (world.effects.paths) {
        length = world::until_next_row(world, left);
        world::follow_paths(world, length);
      }
      advance(world, {start, length, level}, listeners, report);
    }
  }
  world.part_start = 0;
  fall_asleep(world, report);
  report.step.step_ns = watch.ns();
  report.step.ccd_ns = report.step.step_ns - report.step.lcp_ns;
  return report;
}

// ANCHOR: step
void Resting::advance(world::World& world, const Part& part, const world::Listeners& listeners,
                      RestReport& report) {
  begin(world, part, report);
  take(world);
  for (const std::vector<int>& members : islands_of(world, shell_.contacts(), taken_))
    solve(world, members, report);                                      // contacts that last
  solve_crowd(world, report);                                           // those of which there are too many
  steer(world, report);                                                 // gaps
  const bool proved = prove(world, report) || put_back(world, report);  // the way
  if (!proved && part.level < kMostHalvings) return halve(world, part, listeners, report);
  if (!finish(world, part, listeners, report)) halve(world, part, listeners, report);  // chapter 4: the rest
}
// ANCHOR_END: step

// This part of the frame is taken back, and done in two.
void Resting::halve(world::World& world, const Part& part, const world::Listeners& listeners,
                    RestReport& report) {
  keep_for_halves();
  world.bodies = saved_[at(part.level)];
  report.step.lost_time = lost_[at(part.level)];
  halvings_ = std::max(halvings_, part.level + 1);
  for (const double half : {0.0, 0.5 * part.length})
    advance(world, {part.start + half, 0.5 * part.length, part.level + 1}, listeners, report);
}

// The way is as good as it gets: chapter 4's step does everything else. False if it had to hold somebody who
// may go on in halves: nothing is told of this part then.
bool Resting::finish(world::World& world, const Part& part, const world::Listeners& listeners,
                     RestReport& report) {
  const RestReport before = report;
  settle(world, report);
  const world::Listeners later = world::from(part.start, listeners);
  const auto sighted = world.sighted;
  told_.clear();
  world::Listeners first;  // what is told cannot be taken back: it waits
  if (later.impact)
    first.impact = [&](const world::ImpactRecord& impact) {
      told_.emplace_back([&later, impact] { later.impact(impact); });
    };
  if (later.sighting)
    first.sighting = [&](const world::Sighting& sighting) {
      told_.emplace_back([&later, sighting] { later.sighting(sighting); });
    };
  if (later.instant)
    first.instant = [&](const world::World& now, double time) {
      told_.emplace_back([&later, &world, bodies = now.bodies, time]() mutable {
        world.bodies.swap(bodies);
        later.instant(world, time);
        world.bodies.swap(bodies);
      });
    };
  std::vector<world::Body> at_start = later.instant ? world.bodies : std::vector<world::Body>();
  const world::StepReport rest = world::step(world, dt_, first);
  if (rest.lost_time > 0 && part.level < kMostHalvings) {
    report = before;
    world.sighted = sighted;
    return false;
  }
  if (later.instant) world.bodies.swap(at_start);  // contacts that last are told as of the start
  tell(world, later, report);
  if (later.instant) world.bodies.swap(at_start);
  for (const auto& tell_now : told_) tell_now();
  world::add(rest, report.step);
  return true;
}

// Where everything stands, which contacts there are, and what gravity will have made of the velocities by the
// frame's end. (A body that was held did not live through the last frame: it has that frame's gravity
// already.)
void Resting::begin(world::World& world, const Part& part, RestReport& report) {
  const double share = part.length / dt_;  // of the impulses that were
  dt_ = part.length;
  world.part_start = part.start;
  world.rest_speed = shell_.envelope() / dt_;
  given_.clear();
  start_.clear();
  sweeps_.clear();
  for (world::Body& body : world.bodies) {
    body.supported = body.steered = body.foreseen = false;
    given_.push_back(body.state);
    start_.push_back(body.state);
    if (world.effects.gravity && !body.state.is_static() && !body.was_held && !body.asleep)
      start_.back().velocity += dt_ * world.gravity_on(body.state);
    const bool moves = !world.stays(static_cast<int>(start_.size()) - 1);
    sweeps_.push_back({body.state.position, 0, 0});
    if (!moves) continue;
    sweeps_.back().end += dt_ * start_.back().velocity;
    sweeps_.back().turn = dt_ * body.state.spin.norm();
    if (world.effects.gravity) sweeps_.back().sag = 0.125 * dt_ * dt_ * world.effects.gravity->norm();
  }
  shell_.find(world, sweeps_);
  wake_touched(world, report);
  saved_[at(part.level)] = world.bodies;
  lost_[at(part.level)] = report.step.lost_time;
  for (ShellContact& contact : shell_.contacts()) {
    contact.bounce = std::exchange(contact.bounce_next, 0);
    contact.impulse *= share;
  }
  find_crowds(world);
  resting_.assign(world.bodies.size(), 0);
  changed_.assign(world.bodies.size(), 1);
  tracks_.resize(world.bodies.size());
  for (int body = 0; body < static_cast<int>(tracks_.size()); ++body) follow(world, body);
  taken_.clear();
  row_.clear();
  end_gaps_.clear();
  contact_of_.clear();
  reaches_.clear();
  for (const world::Body& body : world.bodies) reaches_.push_back(world.shapes[body.shape].reach);
  crowd_.begin(start_, reaches_);
}

// Bodies that are near each other, over others if need be, with more rows than are solved exactly.
void Resting::find_crowds(const world::World& world) {
  Joined joined(world.bodies.size());
  for (const ShellPair& pair : shell_.pairs())
    if (world.yields(pair.a) && world.yields(pair.b)) joined.join(pair.a, pair.b);
  std::vector<int> rows(world.bodies.size(), 0);
  for (const ShellPair& pair : shell_.pairs())
    rows[at(joined.root(world.yields(pair.a) ? pair.a : pair.b))] += pair.count;
  crowded_.assign(world.bodies.size(), 0);
  for (int body = 0; body < static_cast<int>(crowded_.size()); ++body)
    crowded_[at(body)] = world.yields(body) && rows[at(joined.root(body))] > options_.crowd;
}

// What comes in faster than the shell allows is an impact, and chapter 4's, unless it has no way left to come
// in. In a crowd every contact is a row. Looks at those that it has not looked at yet.
void Resting::take(const world::World& world) {
  const double fast = shell_.envelope() / dt_, middle = 0.5 * shell_.envelope();
  const std::vector<ShellContact>& shell = shell_.contacts();
  for (std::size_t i = taken_.size(); i < shell.size(); ++i) {
    const lcp::Contact& c = shell[i].contact;
    row_.push_back(-1);
    taken_.push_back(0);
    if (rests(world, c.body_a) && rests(world, c.body_b)) continue;
    if (is_crowded(c)) {
      add_row(static_cast<int>(i));
    } else {
      const double closing = -lcp::contact_velocity(given_, c);
      taken_[i] = c.restitution == 0 || closing <= std::max(fast, (c.gap - middle) / dt_) ||
                  c.gap < kNoWay * world.tolerance;
    }
  }
}

// How fast a contact may close in, m/s; negative: it must part. `before` is its velocity with gravity's part.
double Resting::allowed(ShellContact& c) const {
  const double middle = 0.5 * shell_.envelope(), fast = shell_.envelope() / dt_;
  c.before = lcp::contact_velocity(start_, c.contact);
  if (c.bounce > 0) return -c.bounce;
  // Whether it bounces is asked without what gravity will do in this part of the frame, as in take().
  const double closing = -lcp::contact_velocity(given_, c.contact);
  if (is_crowded(c.contact) && c.contact.restitution > 0 && closing > fast &&
      c.contact.gap <= shell_.envelope())
    return -c.contact.restitution * closing;
  return std::max(0.0, c.contact.gap - middle) / dt_;
}

// Bodies that are driven into what cannot give way stand still for this part of the frame; whether there are.
bool Resting::stop_driven(world::World& world, Island& island, RestReport& report) {
  bool any = false;
  for (std::size_t k = 0; k < island.bodies.size(); ++k) {
    const int number = island.numbers[k];
    if (!world.carries(number)) continue;
    island.bodies[k].velocity = island.bodies[k].spin = Vec3::Zero();
    world.bodies[number].held = any = true;
    report.step.lost_time = std::max(report.step.lost_time, dt_);
    follow(world, number);
  }
  return any;
}

void Resting::solve(world::World& world, const std::vector<int>& members, RestReport& report) {
  const Stopwatch watch;
  std::vector<ShellContact>& shell = shell_.contacts();
  Island island(start_, shell, members, place_);
  allowed_.clear();
  impulses_.clear();
  for (std::size_t k = 0; k < members.size(); ++k) {
    ShellContact& c = shell[at(members[k])];
    allowed_.push_back(allowed(c));
    impulses_.push_back(c.impulse);
  }
  IslandResult result = solver_.solve(island.bodies, island.contacts, allowed_, impulses_, options_.small);
  if (!result.solved && stop_driven(world, island, report))
    result = solver_.solve(island.bodies, island.contacts, allowed_, impulses_, options_.small);
  if (!result.solved && options_.small.chosen)
    throw lcp::unsolved(world.solver, result.status, result.sweeps, result.residual);
  if (!result.solved)
    throw SceneFailure(
        fmt::format(
            "{} resting contacts that belong together could not be solved: a residual of {:.2g} was left "
            "after {} sweeps, {:g} may be; shorten step.dt, or take less unequal masses",
            members.size(), result.residual, result.sweeps, options_.small.accepted),
        "envelope");
  const int rows = static_cast<int>(members.size());
  if (!options_.small.chosen) report.sweeps += result.sweeps;
  report.largest_island = std::max(report.largest_island, rows);
  report.step.contacts += rows;
  report.step.lcp_rows += rows;
  ++report.step.solves;
  report.step.lcp_residual = std::max(report.step.lcp_residual, result.residual);

  const Vec3 gravity = world.effects.gravity.value_or(Vec3(Vec3::Zero()));
  std::vector<char> pushed(island.bodies.size()), supported(island.bodies.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    const lcp::Contact& contact = island.contacts[k];
    ShellContact& c = shell[at(members[k])];
    c.impulse = impulses_[k];
    c.after = lcp::contact_velocity(island.bodies, contact);
    if (!(impulses_[k] > 0)) continue;
    pushed[at(contact.body_a)] = pushed[at(contact.body_b)] = 1;
    if (world::bears_weight(contact.normal, gravity))
      supported[at(contact.body_a)] = supported[at(contact.body_b)] = 1;
  }
  for (std::size_t k = 0; k < island.bodies.size(); ++k) {
    RigidBody& body = island.bodies[k];
    if (body.is_static()) continue;
    const double reach = tracks_[at(island.numbers[k])].reach;
    const double way = dt_ * (body.velocity.norm() + reach * body.spin.norm());
    if (supported[k] && way < kStill * shell_.envelope()) body.velocity = body.spin = Vec3::Zero();
    take_course(world, island.numbers[k], pushed[k], supported[k], body);
    follow(world, island.numbers[k]);
  }
  report.step.lcp_ns += watch.ns();
}

// What was pushed moves straight on; what was not falls in closed form. Pushed by walls alone it goes on
// falling, too: gravity will add again what is in its velocity.
void Resting::take_course(world::World& world, int number, bool pushed, bool supported, RigidBody state) {
  world::Body& body = world.bodies[number];
  const bool was_pushed = resting_[at(number)] == 2;
  resting_[at(number)] = pushed ? 2 : 1;
  if (!pushed) {
    if (!was_pushed) return;
    state = given_[at(number)];
    supported = false;
  } else if (!supported) {
    state.velocity -= start_[at(number)].velocity - given_[at(number)].velocity;
  }
  if (body.asleep && state.velocity.isZero(0) && state.spin.isZero(0)) return;  // nothing wakes it
  body.supported = supported;
  world.set_course(number, state, 0);
}

// Guesses, and who is to bounce.
void Resting::keep_for_halves() {
  for (ShellContact& contact : shell_.contacts()) contact.bounce_next = contact.bounce;
  for (int row = 0; row < crowd_.rows(); ++row)
    shell_.contacts()[at(contact_of_[at(row)])].impulse = crowd_.impulse(row);
}

void Resting::tell(const world::World& world, const world::Listeners& listeners, RestReport& report) {
  report.searched += shell_.searched();
  report.shell_contacts += static_cast<int>(shell_.contacts().size());
  report.smallest_gap = std::min(report.smallest_gap, shell_.smallest_gap());
  report.step.min_gap = std::min(report.step.min_gap, shell_.smallest_gap());
  report.step.max_penetration = std::max(report.step.max_penetration, -std::min(0.0, shell_.smallest_gap()));
  report.crowded =
      std::max(report.crowded, static_cast<int>(std::count(crowded_.begin(), crowded_.end(), 1)));
  for (int row = 0; row < crowd_.rows(); ++row) {
    ShellContact& c = shell_.contacts()[at(contact_of_[at(row)])];
    c.impulse = crowd_.impulse(row);
    c.after = crowd_.speed(row);
  }
  bool any = false;
  for (std::size_t i = 0; i < taken_.size(); ++i) {
    const ShellContact& c = shell_.contacts()[i];
    if (!(taken_[i] || row_[i] >= 0) || !(c.impulse > 0)) continue;
    const bool bounces = c.bounce > 0;
    ++(bounces ? report.step.impacts : report.resting);
    report.step.kinematic_work += lcp::kinematic_work(start_, c.contact, c.impulse);
    any = true;
    if (!listeners.impact) continue;
    const auto kind = bounces ? world::ContactKind::impact : world::ContactKind::rest;
    listeners.impact({0, c.contact, {0, 0, c.before, c.after, c.impulse}, kind});
  }
  if (listeners.instant && any) listeners.instant(world, 0);
}

}  // namespace fc::resting

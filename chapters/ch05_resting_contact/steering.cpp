// Of a frame: gaps put right by positions alone, and the proof that nothing overlaps on the way.
#include <algorithm>
#include <cmath>

#include "ch05_resting_contact/resting.hpp"

namespace fc::resting {
namespace {

// Of what a gap lacks to half the envelope, so much is made up in a frame; below the second part of the
// envelope all of it.
constexpr double kSteerShare = 0.2, kLeastGap = 0.25;

constexpr double kNearMiddle = 1 - 1e-3;  // of the middle: a gap above it is let be
constexpr double kSteerResidual = 1e-3;   // positions need no more: the way is proved afterwards

// Where velocities are mended, a change that moves nothing by this part of the envelope matters to no other
// row.
constexpr double kEnough = 0.05;

// By so much more than it lacks at the time of a way's nearest point its end is moved, at most.
constexpr double kMostLift = 4;

// A way is good if every gap stays above this part of the envelope, or half of what it was.
constexpr double kFloor = 1.0 / 64;

constexpr int kMostRounds = 2;  // in which ways are mended

}  // namespace

void Resting::follow(const world::World& world, int body) {
  tracks_[at(body)] = track_of(world, body, shell_.poses()[at(body)], dt_);
  const Track& track = tracks_[at(body)];
  sweeps_[at(body)] = {track.end.position, track.spin_rate * dt_,
                       0.125 * dt_ * dt_ * track.acceleration.norm()};
  changed_[at(body)] = 1;
}

// By how much a gap may shrink (m), to put gaps right; negative: by how much it must grow.
double Resting::slack(double gap) const {
  const double envelope = shell_.envelope(), middle = 0.5 * envelope;
  if (gap >= kNearMiddle * middle) return std::max(0.0, gap - middle);
  return -std::max(kSteerShare * (middle - gap), kLeastGap * envelope - gap);
}

void Resting::steer(world::World& world, RestReport& report) {
  const std::vector<ShellContact>& shell = shell_.contacts();
  const std::size_t known = end_gaps_.size();
  end_gaps_.resize(shell.size());
  for (std::size_t i = 0; i < shell.size(); ++i) {
    const lcp::Contact& c = shell[i].contact;
    if (i >= known || changed_[at(c.body_a)] || changed_[at(c.body_b)])
      end_gaps_[i] = shell[i].gap_at(tracks_[at(c.body_a)].end, tracks_[at(c.body_b)].end) - shell[i].lift;
  }
  for (const std::vector<int>& members : islands_of(world, shell, taken_))
    if (std::any_of(members.begin(), members.end(), [&](int i) { return slack(end_gaps_[at(i)]) < 0; }))
      steer_island(world, members, report);
  if (crowd_.rows() > 0) steer_crowd(world, report);
}

// Displacements are velocities for one unit of time, from rest. A gap may shrink by what it has above the
// middle; one below it must grow.
void Resting::steer_island(world::World& world, const std::vector<int>& members, RestReport& report) {
  const double envelope = shell_.envelope();
  Island island(start_, shell_.contacts(), members, place_);
  for (RigidBody& body : island.bodies) body.velocity = body.spin = Vec3::Zero();
  allowed_.clear();
  for (const int i : members) allowed_.push_back(slack(end_gaps_[at(i)]));
  impulses_.assign(members.size(), 0);
  IslandOptions rough;
  rough.residual = kSteerResidual;
  rough.accepted = 1;
  rough.most_sweeps = 50;
  const IslandResult result = solver_.solve(island.bodies, island.contacts, allowed_, impulses_, rough);
  report.steering_sweeps += result.sweeps;
  if (!result.solved) return;
  double most = 0;
  for (std::size_t k = 0; k < island.bodies.size(); ++k)
    most = std::max(most, island.bodies[k].velocity.norm() +
                              tracks_[at(island.numbers[k])].reach * island.bodies[k].spin.norm());
  const double share = most > kMostSteered * envelope ? kMostSteered * envelope / most : 1;
  for (std::size_t k = 0; k < island.bodies.size(); ++k) {
    const RigidBody& by = island.bodies[k];
    if (by.is_static() || (by.velocity.isZero(0) && by.spin.isZero(0))) continue;
    world::Body& body = world.bodies[island.numbers[k]];
    if (!body.steered) body.steer_velocity = body.steer_spin = Vec3::Zero();
    body.steered = true;
    body.steer_velocity += share / dt_ * by.velocity;
    body.steer_spin += share / dt_ * by.spin;
    follow(world, island.numbers[k]);
  }
}

// Whether this chapter answers for the pair, or chapter 4.
bool Resting::concerns(const world::World& world, const ShellPair& pair) const {
  if (!tracks_[at(pair.a)].moves && !tracks_[at(pair.b)].moves) return false;
  if (crowded_[at(pair.a)] || crowded_[at(pair.b)]) return true;
  if (!resting_[at(pair.a)] && !resting_[at(pair.b)]) return false;
  if (world.restitution_of(pair.a, pair.b) == 0) return true;
  for (const int body : {pair.a, pair.b})
    if (world.yields(body) && !resting_[at(body)]) return false;
  for (int i = pair.first; i < pair.first + pair.count; ++i)
    if (!taken_[at(i)]) return false;
  return true;
}

double Resting::need(const world::World& world, const ShellPair& pair) const {
  const double floor = kFloor * shell_.envelope();
  if (pair.gap >= 2 * floor) return floor;
  if (pair.gap > kFloor * world.tolerance) return 0.5 * pair.gap;
  // It started like this, touching: then it need only not become less, but for rounding.
  const ca::PairPose pose(tracks_[at(pair.a)].start, tracks_[at(pair.b)].start);
  return pair.gap -
         64 * ca::rounding_term(world.model_of(pair.a).whole(), world.model_of(pair.b).whole(), pose);
}

// Proves the ways of all pairs that this chapter answers for, or mends them: where one is not clear the
// contacts that it meets are added, and velocities or positions solved again.
bool Resting::prove(world::World& world, RestReport& report) {
  auto& open = open_;
  for (int round = 0;; ++round) {
    shell_.extend(world, sweeps_);
    take(world);
    open.clear();
    std::vector<ShellPair>& pairs = shell_.pairs();
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      ShellPair& pair = pairs[p];
      if (round == 0 || changed_[at(pair.a)] || changed_[at(pair.b)]) {
        pair.proved = pair.open = false;
        if (!concerns(world, pair)) continue;
        ++report.checked;
        const PathVerdict verdict =
            check_path(world, shell_, pair, tracks_[at(pair.a)], tracks_[at(pair.b)], dt_, need(world, pair));
        pair.proved = verdict.clear;
        const bool event = pair.count == 0 && !crowded_[at(pair.a)] && !crowded_[at(pair.b)] &&
                           world.restitution_of(pair.a, pair.b) > 0;
        pair.open = !verdict.clear && !event;
        pair.nearest_time = verdict.time;
      }
      if (pair.open) open.emplace_back(p, pair.nearest_time);
    }
    std::fill(changed_.begin(), changed_.end(), 0);
    if (open.empty() || round == kMostRounds) break;
    ++report.rounds;
    std::vector<char> again(world.bodies.size(), 0);
    bool solve_again = false;
    std::vector<int> rows;  // of the crowd, new
    for (const auto& [p, time] : open) {
      const bool velocities = mend(world, pairs[p], time);
      for (int i = pairs[p].first; i < pairs[p].first + pairs[p].count; ++i) {
        if (row_[at(i)] >= 0)
          rows.push_back(row_[at(i)]);
        else
          taken_[at(i)] = 1;
      }
      if (velocities) again[at(pairs[p].a)] = again[at(pairs[p].b)] = solve_again = true;
    }
    if (solve_again) {
      for (const std::vector<int>& members : islands_of(world, shell_.contacts(), taken_)) {
        const bool concerned = std::any_of(members.begin(), members.end(), [&](int i) {
          const lcp::Contact& c = shell_.contacts()[at(i)].contact;
          return (world.yields(c.body_a) && again[at(c.body_a)]) ||
                 (world.yields(c.body_b) && again[at(c.body_b)]);
        });
        if (concerned) solve(world, members, report);
      }
    }
    if (!rows.empty()) {
      CrowdOptions rough = options_.crowded;
      rough.enough = kEnough * shell_.envelope() / dt_;
      rough.most_passes = 8;
      crowd_.relax(rows, rough, report.sweeps);
      move_touched(world);
    }
    steer(world, report);
  }
  return open.empty();
}

// The way is as good as it gets.
void Resting::settle(world::World& world, RestReport& report) {
  if (std::any_of(open_.begin(), open_.end(),
                  [&](const auto& o) { return is_crowded_pair(shell_.pairs()[o.first]); }))
    stop_crowd(world, report);
  for (const world::Body& body : world.bodies) {
    if (!body.steered) continue;
    const double reach = world.shapes[body.shape].reach;
    report.steered =
        std::max(report.steered, dt_ * (body.steer_velocity.norm() + reach * body.steer_spin.norm()));
    if (world.effects.gravity)
      report.steering_energy -= dt_ * body.state.mass * world.effects.gravity->dot(body.steer_velocity);
  }
  for (int body = 0; body < static_cast<int>(crowded_.size()); ++body)
    world.bodies[body].foreseen = crowded_[at(body)];
  world.proved.clear();
  for (const ShellPair& pair : shell_.pairs())
    if (pair.proved && !crowded_[at(pair.a)] && !crowded_[at(pair.b)])
      world.proved.emplace_back(pair.a, pair.b);
}

// New contacts for the pair, where its bodies come too near; whether velocities have to know.
bool Resting::mend(world::World& world, ShellPair& pair, double time) {
  const bool known = pair.count > 0;
  const Track &a = tracks_[at(pair.a)], &b = tracks_[at(pair.b)];
  const std::size_t before = shell_.contacts().size();
  const double gap = shell_.search_at(world, pair, a.end, b.end);
  const bool overlaps = !(gap > 0);
  double gap_there = gap;
  const bool between = gap >= need(world, pair);  // it is on the way that they come too near
  if (overlaps || between) {
    // Contacts of a pose that will not be: an exact solution goes by those that it meets before.
    if (!is_crowded_pair(pair)) shell_.contacts().resize(before);
    const ca::Motion motion_a = world.motion(pair.a, 0), motion_b = world.motion(pair.b, 0);
    gap_there = shell_.search_at(world, pair, motion_a.pose_at(time), motion_b.pose_at(time));
    pair.first = static_cast<int>(before);
    pair.count = static_cast<int>(shell_.contacts().size() - before);
  }
  const double fast = shell_.envelope() / dt_;
  for (int i = pair.first; i < pair.first + pair.count; ++i) {
    ShellContact& c = shell_.contacts()[at(i)];
    const double closing = -lcp::contact_velocity(start_, c.contact);
    if (!known && c.contact.restitution > 0 && closing > fast)
      c.bounce_next = c.contact.restitution * closing;
    // What the way makes of the gap, to first order in velocities: it is the way that is mended.
    const Vec3 velocity_a = a.velocity + a.spin.cross(c.contact.point - a.start.position),
               velocity_b = b.velocity + b.spin.cross(c.contact.point - b.start.position);
    if (between)
      c.lift = std::max(0.0, kLeastGap * shell_.envelope() - gap_there) * std::min(dt_ / time, kMostLift);
    c.contact.gap = c.gap_at(a.end, b.end) - dt_ * c.contact.normal.dot(velocity_b - velocity_a);
  }
  take(world);
  return !known || overlaps;
}

}  // namespace fc::resting

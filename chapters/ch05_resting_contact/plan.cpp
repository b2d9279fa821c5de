#include "ch05_resting_contact/plan.hpp"

#include <algorithm>
#include <utility>

#include "ch03_impulse_lcp/unsolved.hpp"

namespace fc::resting {
namespace {

// Of the margin: above this gap a pair that bounces and approaches fast is not yet a contact.
constexpr double kRoom = 0.55;

// A pair that turns in contact is proved sooner by a shorter plan than by ever smaller steps. A proof may examine this
// many pairs of nodes, for two convex bodies and for meshes.
constexpr std::int64_t kMostPairs = 1000, kMostPairsOfMeshes = 50'000;

// The share of the bodies' kinetic energy that pushes may add to it until the plan's end.
constexpr double kMostBorrowed = 0.002;

// In one frame, a body's plans may end this often because impulses have to change.
constexpr int kMostChanges = 8;

constexpr int kHalvings = 16;   // of a plan's time, to find when a point arrives
constexpr int kMostProofs = 4;  // rounds in which unproved pairs become rows

// Whether a pair that bounces approaches fast: it is within the margin, but has room left.
bool comes_in_fast(const IslandPair& pair, std::span<const Member> members, double rest_speed,
                   double margin) {
  const RigidBody &a = members[at(pair.a)].state, &b = members[at(pair.b)].state;
  const Pose pose_a = a.pose(), pose_b = b.pose();
  double nearest = std::numeric_limits<double>::infinity(), fastest = 0;
  for (const ContactPoint& point : pair.contacts->points) {
    nearest = std::min(nearest, point.gap_at(pose_a, pose_b));
    const Vec3 middle = point.middle(pose_a, pose_b);
    fastest =
        std::min(fastest, point.normal_at(pose_a, pose_b).dot(b.velocity_at(middle) - a.velocity_at(middle)));
  }
  return fastest < -rest_speed && nearest > kRoom * margin;
}

}  // namespace

std::shared_ptr<const Planned> PlanMaker::make(const world::World& world, const Island& island, double now,
                                               double dt, const IslandOptions& options,
                                               world::StepReport& report) {
  options_ = options;
  rest_speed_ = contacts_.margin() / dt;
  checked_ = 0;
  rows_.times = {};
  const double left = dt - now;
  double length = left;
  bool may_change = true;
  for (const IslandPair& pair : island.pairs)
    for (ContactPoint& point : pair.contacts->points) point.lasts = false;
  for (const Member& member : island.members) {
    if (!member.dynamic) continue;
    length = std::min(length, lengths_[at(member.number)]);
    may_change = may_change && changes_[at(member.number)] < kMostChanges;
  }
  if (length > kNearlyAll * left) length = left;
  for (bool shortened = false;;) {
    const PlanResult result = try_length(world, island, now, length, may_change);
    checked_ += courses_.checked();
    report.solves += rows_.solves;
    report.lcp_residual = std::max(report.lcp_residual, rows_.residual);
    if (result == PlanResult::unsolved) {
      if (!options.chosen) return {};
      throw lcp::unsolved(world.solver, rows_.failed.status, rows_.failed.steps, rows_.residual);
    }
    if (result == PlanResult::proved) {
      for (const Member& member : island.members)
        lengths_[at(member.number)] = shortened ? length : 2 * length;
      return std::make_shared<const Planned>(take());
    }
    const bool changes = result == PlanResult::changes;
    if (changes)
      for (const Member& member : island.members) ++changes_[at(member.number)];
    shortened = shortened || !changes;
    const bool meets = (changes || result == PlanResult::meets) && meeting_ > kShortest * dt;
    if (!meets && length < kShortest * dt) return {};
    length = meets ? std::min(meeting_, 0.999 * length) : 0.5 * length;
  }
}

// One plan of this length, from now on.
PlanResult PlanMaker::try_length(const world::World& world, const Island& island, double now, double length,
                                 bool may_change) {
  const double margin = contacts_.margin();
  courses_.start(world, island.members, now, length);
  rows_.start(options_);
  for (const IslandPair& pair : island.pairs) {
    if (comes_in_fast(pair, courses_.members, rest_speed_, margin)) continue;
    const int candidate = courses_.candidate_of(pair.contacts, pair.a, pair.b);
    courses_.candidates[at(candidate)].in_contact = !pair.contacts->points.empty();
    for (const ContactPoint& point : pair.contacts->points) {
      const PlanRow row = rows_.row_of(world, candidate, point, false);
      if (row.contact.gap <= margin)
        rows_.rows.push_back(row);  // later the proofs find what arrives, and how fast
    }
  }
  const auto options_of = [&](const Candidate& pair) {
    if (!pair.in_contact) return PathOptions{.required_gap = kStop * margin};
    const std::int64_t most = Contacts::convex(world, *pair.contacts) ? kMostPairs : kMostPairsOfMeshes;
    return PathOptions{.required_gap = kFloor * margin, .most_pairs = most};
  };
  const auto acts_on_air = [&](const PlanRow& row) {  // an impulse across more than the margin
    return row.push() > 0 && row.arrives && row.end_gap > margin;
  };
  for (int round = 0; round < kMostProofs; ++round) {
    const PlanResult ends = rows_.close();
    if (ends != PlanResult::proved) return ends;
    if (gains()) return PlanResult::unproved;
    if (may_change && (meeting_ = rows_.holds_until()) < length) return PlanResult::changes;
    const TimeInto time(rows_.times.proofs_ns);
    courses_.find(world, false);
    for (std::size_t i = rows_.fast.size(); i < courses_.members.size(); ++i)
      for (std::vector<RigidBody>* bodies : {&rows_.fast, &rows_.path})
        bodies->push_back(courses_.members[i].state);
    const bool clear = courses_.prove(world, options_of);
    if (std::any_of(rows_.rows.begin(), rows_.rows.end(), acts_on_air)) return PlanResult::unproved;
    if (clear) return PlanResult::proved;
    bool any = false;
    meeting_ = length;
    for (int i = 0; i < static_cast<int>(courses_.candidates.size()); ++i)
      if (!courses_.candidates[at(i)].clear && add_rows_of(world, i)) any = true;
    if (meeting_ < length) return PlanResult::meets;
    if (!any) return PlanResult::unproved;
  }
  return PlanResult::unproved;
}

// Whether the pushes add more kinetic energy than a plan may borrow until its end takes it back. Bodies that turn a
// plane by an angle of t on a path borrow t^2 / 4 of theirs. Also whether bodies that turn freely would gain energy at
// the end, where their spins change as if nothing had pushed them.
bool PlanMaker::gains() const {
  double gain = 0, size = 0, end_gain = 0;
  for (std::size_t i = 0; i < courses_.members.size(); ++i) {
    if (!courses_.members[i].dynamic) continue;
    RigidBody free = courses_.members[i].state, fast = rows_.fast[i];
    free.velocity = courses_.drift[i].linear;
    free.spin = courses_.drift[i].angular;
    const double before = free.kinetic_energy(), slow = contacts_.margin() / courses_.length();
    gain += fast.kinetic_energy() - before;
    size += before + 0.5 * free.mass * slow * slow;
    if (courses_.last[i].angular.isZero(0)) continue;
    free.spin = courses_.members[i].state.spin;
    fast.spin += courses_.last[i].angular;
    fast.orientation = Quat(courses_.paths[i].end.rotation);
    end_gain += fast.kinetic_energy() - free.kinetic_energy();
  }
  for (const PlanRow& row : rows_.rows) gain -= lcp::kinematic_work(rows_.fast, row.contact, row.impulse);
  return std::max(gain, end_gain) > kMostBorrowed * size;
}

// Adds rows for the points that an unproved pair has at the end of its path; returns whether there are new ones. A
// point that approaches fast there is an event instead, unless it belongs to the next faces of a mesh that is in
// contact.
bool PlanMaker::add_rows_of(const world::World& world, int candidate) {
  const Candidate pair = courses_.candidates[at(candidate)];
  const Path &a = courses_.paths[at(pair.a)], &b = courses_.paths[at(pair.b)];
  const bool may_meet = !pair.in_contact || Contacts::convex(world, *pair.contacts);
  double gap = 0;
  bool any = false;
  for (const ContactPoint& point : contacts_.points_at(world, *pair.contacts, a.end, b.end, gap)) {
    const auto is_known = [&](const PlanRow& row) {
      return row.pair == candidate && row.point.is_same(point, contacts_.margin());
    };
    if (std::any_of(rows_.rows.begin(), rows_.rows.end(), is_known)) continue;
    const PlanRow row = rows_.row_of(world, candidate, point, true);
    if (may_meet && rows_.end_speed(row, rows_.path) < -rest_speed_) {
      const double there = pair.in_contact ? arrival(row) : pair.time;
      if (there <= pair.time)
        meeting_ = std::min(meeting_, there);  // otherwise something else comes first: a shorter plan
    } else {
      rows_.rows.push_back(row);
      any = true;
    }
  }
  return any;
}

// When (s from the start) a point of a pair has come down to the rest gap, if its bodies follow these paths.
double PlanMaker::arrival(const PlanRow& row) const {
  const Path &a = courses_.paths[at(row.contact.body_a)], &b = courses_.paths[at(row.contact.body_b)];
  double early = 0, late = courses_.length();
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (early + late);
    const bool there =
        row.point.gap_at(a.motion.pose_at(middle), b.motion.pose_at(middle)) < 0.5 * contacts_.margin();
    (there ? late : early) = middle;
  }
  return late;
}

// Stores guesses for the next plan, and which contacts last: all points that stay in contact, if one of the pair's
// points pushes.
void PlanMaker::remember() const {
  std::vector<char> pushes(courses_.candidates.size(), 0);
  for (const PlanRow& row : rows_.rows) pushes[at(row.pair)] |= row.push() > 0 && !row.arrives;
  for (const PlanRow& row : rows_.rows)
    for (ContactPoint& point : courses_.candidates[at(row.pair)].contacts->points) {
      if (point.key != row.point.key) continue;
      point.force = row.impulse / courses_.length();
      point.lasts = pushes[at(row.pair)] && !row.arrives && row.end_gap <= contacts_.margin();
    }
}

// The bodies that follow the plan: those that are pushed, or end in contact.
Planned PlanMaker::take() {
  const double length = courses_.length();
  remember();
  Planned result;
  std::vector<char> goes(courses_.members.size(), 0);
  const std::vector<RigidBody> free = courses_.with(courses_.drift), ends = rows_.without_arrivals();
  for (const PlanRow& row : rows_.rows) {
    const bool pushes = row.push() > 0 || row.early.dot(row.contact.normal) > 0;
    if (pushes || row.correction > 0 || row.end_gap < contacts_.margin())
      for (const int member : {row.contact.body_a, row.contact.body_b}) goes[at(member)] = 1;
    if (!pushes) continue;
    ++result.pushing;
    result.kinematic_work += lcp::kinematic_work(rows_.fast, row.contact, row.impulse);
    result.early_work += lcp::kinematic_work(rows_.fast, row.contact, row.early);
    result.rows.push_back({.contact = row.contact,
                           .impulse = row.impulse,
                           .early = row.early,
                           .before = lcp::relative_velocity(free, row.contact),
                           .after = lcp::relative_velocity(rows_.fast, row.contact),
                           .key = row.point.key,
                           .arrives = row.arrives});
    lcp::Contact& contact = result.rows.back().contact;
    if (row.arrives) {
      contact.gap = row.end_gap;
      contact.point =
          row.point.middle(courses_.paths[at(contact.body_a)].end, courses_.paths[at(contact.body_b)].end);
    }
    for (int* body : {&contact.body_a, &contact.body_b}) *body = courses_.members[at(*body)].number;
  }
  for (std::size_t i = 0; i < courses_.members.size(); ++i) {
    const RigidBody &path = rows_.path[i], &fast = rows_.fast[i], &end = ends[i];
    const double moved = length * ((path.velocity - fast.velocity).norm() +
                                   courses_.paths[i].reach * (path.spin - fast.spin).norm());
    result.correction = std::max(result.correction, moved);
    if (!goes[i] || !courses_.members[i].dynamic) continue;
    const Twist last = courses_.last[i];
    result.bodies.push_back(courses_.members[i].number);
    result.motions.push_back(planned_motion(courses_.members[i], {path.velocity, path.spin},
                                            {end.velocity + last.linear, end.spin + last.angular}, length));
    result.arrivals.push_back({fast.velocity - end.velocity, fast.spin - end.spin});
  }
  return result;
}

}  // namespace fc::resting

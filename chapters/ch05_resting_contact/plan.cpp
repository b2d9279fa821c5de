#include "ch05_resting_contact/plan.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {
namespace {

// Of what a gap lacks of the rest gap, so much is put right in a plan; gaps below this part of the margin at once.
constexpr double kCorrect = 0.2, kLeastGap = 0.25;
constexpr double kNearRest = 0.99999;  // of the rest gap: nothing is put right from here on

// A path is clear if its gap stays above this part of the margin, or half of what it was.
constexpr double kFloor = 1.0 / 64;

// Of the margin: two bodies that come in fast, and bounce, are stopped at half of this gap, as in chapter 4.
constexpr double kStop = 0.25;

// Of the margin: a pair that bounces and comes in fast is no contact yet above this gap.
constexpr double kRoom = 0.55;

// A pair that turns in contact is proved sooner by a shorter plan than by ever smaller steps: so many pairs of nodes are
// looked at, of two convex bodies and of meshes.
constexpr std::int64_t kMostPairs = 1000, kMostPairsOfMeshes = 50'000;

// Of the bodies' kinetic energy, by which pushes may add to it until the plan's end.
constexpr double kMostBorrowed = 0.002;

constexpr int kHalvings = 16;           // of a plan's time, to find when a point arrives
constexpr int kMostProofs = 4;          // rounds in which unproved pairs become rows
constexpr int kMostRounds = 8;          // in which the paths' ends are looked at again
constexpr double kNearlyClosed = 1e-2;  // else a shorter plan is made
constexpr double kClosed = 1e-6;        // of the margin: how exactly contacts close at the plan's end
constexpr double kCloseEnough = 1e-4;   // the same, where slips bend, after the patient rounds
constexpr int kPatientRounds = 4;

// Whether a pair that bounces comes in fast: it is in the margin, but there is room left.
bool comes_in_fast(const IslandPair& pair, std::span<const Member> members, double rest_speed,
                   double margin) {
  if (pair.contacts->points.empty()) return false;
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

double wanted_gap(double gap, double margin) {
  const double rest = 0.5 * margin;
  if (gap >= kNearRest * rest) return std::min(gap, rest);
  return std::max(gap + kCorrect * (rest - gap), kLeastGap * margin);
}

// ANCHOR: planned_motion
world::Plan planned_motion(const Member& member, const Twist& path, const Twist& end, double length) {
  world::Plan motion;
  motion.linear = path.linear;
  motion.angular = path.angular;
  motion.push = (end.linear - member.state.velocity) / length;
  motion.turn = (end.angular - member.state.spin) / length;
  return motion;
}
// ANCHOR_END: planned_motion

PlanMaker::Result PlanMaker::make(const world::World& world, const Island& island, double now, double length,
                                  const PlanOptions& options) {
  options_ = options;
  residual_ = 0;
  solves_ = 0;
  rows_.clear();
  courses_.start(world, island.members, now, length);
  for (const IslandPair& pair : island.pairs) {
    if (comes_in_fast(pair, courses_.members, options_.rest_speed, contacts_.margin())) continue;
    const int candidate = courses_.candidate_of(pair.contacts, pair.a, pair.b);
    courses_.candidates[at(candidate)].in_contact = !pair.contacts->points.empty();
    for (const ContactPoint& point : pair.contacts->points) add_row(world, candidate, point, false);
    std::erase_if(rows_,
                  [](const Row& row) { return row.arrives; });  // proofs find out who does, and how fast
  }
  const auto options_of = [&](const Candidate& pair) {
    if (!pair.in_contact) return PathOptions{.required_gap = kStop * contacts_.margin()};
    const std::int64_t most = Contacts::convex(world, *pair.contacts) ? kMostPairs : kMostPairsOfMeshes;
    return PathOptions{.required_gap = kFloor * contacts_.margin(), .most_pairs = most};
  };
  const auto acts_on_air = [&](const Row& row) {  // an impulse across more than the margin
    return row.push() > 0 && row.arrives && row.end_gap > contacts_.margin();
  };
  const auto is_put_out = [&](const Row& row) {  // of contact, by corrections, although it pushes
    return row.push() > 0 && !row.arrives && row.end_gap > contacts_.margin();
  };
  corrects_ = true;
  for (int round = 0; round < kMostProofs; ++round) {
    Result ends = close_ends();
    if (corrects_ && std::any_of(rows_.begin(), rows_.end(), is_put_out)) {
      corrects_ = false;
      ends = close_ends();
    }
    if (ends != Result::proved) return ends;
    if (gains()) return Result::unproved;
    if (options_.may_change && (meeting_ = holds_until()) < length) return Result::changes;
    courses_.find(world, false);
    for (std::size_t i = fast_.size(); i < courses_.members.size(); ++i) {
      fast_.push_back(courses_.members[i].state);
      path_.push_back(courses_.members[i].state);
    }
    const bool clear = courses_.prove(world, options_of);
    if (std::any_of(rows_.begin(), rows_.end(), acts_on_air)) return Result::unproved;
    if (clear) return Result::proved;
    bool any = false;
    meeting_ = length;
    for (int i = 0; i < static_cast<int>(courses_.candidates.size()); ++i)
      if (!courses_.candidates[at(i)].clear && add_rows_of(world, i)) any = true;
    if (meeting_ < length) return Result::meets;
    if (!any) return Result::unproved;
  }
  return Result::unproved;
}

void PlanMaker::add_row(const world::World& world, int candidate, const ContactPoint& point, bool arrives) {
  const Candidate& pair = courses_.candidates[at(candidate)];
  const Member &a = courses_.members[at(pair.a)], &b = courses_.members[at(pair.b)];
  const Pose pose_a = a.state.pose(), pose_b = b.state.pose();
  Row row;
  row.pair = candidate;
  row.point = point;
  row.gap = point.gap_at(pose_a, pose_b);
  row.arrives = arrives || row.gap > contacts_.margin();
  row.contact = {pair.a,  pair.b, point.middle(pose_a, pose_b), point.normal_at(pose_a, pose_b),
                 row.gap, 0,      world.turns(a.number),        world.turns(b.number)};
  const double gap = arrives ? std::min(pair.contacts->gap, 0.5 * contacts_.margin()) : row.gap;
  row.keep = std::min(gap, 0.5 * contacts_.margin());
  row.want = wanted_gap(gap, contacts_.margin());
  if (!arrives) row.impulse = courses_.length() * point.force;
  rows_.push_back(row);
}

ContactSet PlanMaker::set_of(std::vector<RigidBody>& bodies) {
  numbers_.clear();
  for (const Member& member : courses_.members) numbers_.push_back(member.number);
  return {bodies, numbers_, contact_list_, bends_};
}

bool PlanMaker::counts(const IslandResult& result) {
  residual_ = std::max(residual_, result.residual);
  ++solves_;
  if (!result.solved) {
    status_ = result.status;
    steps_ = result.steps;
  }
  return result.solved;
}

// From impulses_, with approach_limits_; bodies get the velocities.
bool PlanMaker::push(std::vector<RigidBody>& bodies) {
  return contact_list_.empty() ||
         counts(law_.push(set_of(bodies), approach_limits_, impulses_, options_.solver));
}

// Steps 1 and 2, with the rows' right-hand sides as they are.
bool PlanMaker::solve() {
  fast_ = courses_.with(courses_.drift);
  contact_list_.clear();
  approach_limits_.clear();
  bends_.clear();
  impulses_.clear();
  for (const Row& row : rows_) {
    contact_list_.push_back(row.contact);
    approach_limits_.push_back(row.approach_limit(courses_.length()));
    bends_.push_back(row.slip_bend);
    impulses_.push_back(row.impulse);
  }
  if (!push(fast_)) return false;
  for (std::size_t r = 0; r < rows_.size(); ++r) rows_[r].impulse = impulses_[r];
  if (!correct()) {  // nothing to put right, or no room for all of it: gaps stay as they are
    path_ = fast_;
    std::fill(corrections_.begin(), corrections_.end(), 0.0);
  }
  for (std::size_t r = 0; r < rows_.size(); ++r) rows_[r].correction = corrections_[r];
  return true;
}

bool PlanMaker::correct() {
  const double length = courses_.length();
  path_ = fast_;
  corrections_.clear();
  bool short_of = false;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    approach_limits_[r] = (row.gap + row.bend - row.want) / length;
    corrections_.push_back(row.correction);
    if (lcp::contact_velocity(path_, row.contact) + approach_limits_[r] <
        -kClosed * contacts_.margin() / length)
      short_of = true;
  }
  return corrects_ && short_of &&
         counts(law_.correct(set_of(path_), approach_limits_, corrections_, options_.solver));
}

// The contact's velocity (m/s) at the end of the paths, if bodies have these velocities.
double PlanMaker::end_speed(const Row& row, const std::vector<RigidBody>& bodies) const {
  const Path &path_a = courses_.paths[at(row.contact.body_a)],
             &path_b = courses_.paths[at(row.contact.body_b)];
  const RigidBody &a = bodies[at(row.contact.body_a)], &b = bodies[at(row.contact.body_b)];
  const Vec3 arm_a = row.point.on_a(path_a.end, path_b.end) - path_a.end.position,
             arm_b = row.point.on_b(path_a.end, path_b.end) - path_b.end.position;
  return row.point.normal_at(path_a.end, path_b.end)
      .dot(b.velocity + b.spin.cross(arm_b) - a.velocity - a.spin.cross(arm_a));
}

// How much larger the contact's slip is in the middle of the paths, where its bodies stand and its point is then.
Vec3 PlanMaker::slip_bend(const Row& row) const {
  const Path &path_a = courses_.paths[at(row.contact.body_a)],
             &path_b = courses_.paths[at(row.contact.body_b)];
  const double half = 0.5 * courses_.length();
  const Pose a = path_a.motion.pose_at(half), b = path_b.motion.pose_at(half);
  const RigidBody &of_a = fast_[at(row.contact.body_a)], &of_b = fast_[at(row.contact.body_b)];
  const Vec3 half_gap = 0.5 * row.point.gap_at(a, b) * row.point.normal_at(a, b);
  // The plane's own point stays behind where the other body's goes on.
  const Vec3 point =
      row.point.of_b ? Vec3(row.point.on_a(a, b) + half_gap) : Vec3(row.point.on_b(a, b) - half_gap);
  Vec3 slip = of_b.velocity - of_a.velocity;
  if (row.contact.turns_b) slip += of_b.spin.cross(point - b.position);
  if (row.contact.turns_a) slip -= of_a.spin.cross(point - a.position);
  const Vec3 bend = slip - lcp::relative_velocity(fast_, row.contact);
  return bend - row.contact.normal.dot(bend) * row.contact.normal;
}

// Solves until the gaps at the end are what the rows say of them.
// ANCHOR: close_ends
PlanMaker::Result PlanMaker::close_ends() {
  double worst = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    if (!solve()) return Result::unsolved;
    for (std::size_t i = 0; i < courses_.members.size(); ++i)
      courses_.go(static_cast<int>(i), {path_[i].velocity, path_[i].spin});
    worst = 0;
    for (Row& row : rows_) {
      const Path &a = courses_.paths[at(row.contact.body_a)], &b = courses_.paths[at(row.contact.body_b)];
      row.end_gap = row.point.gap_at(a.end, b.end);
      if (row.end_gap >= contacts_.margin() && !(row.push() > 0 || row.correction > 0)) continue;
      const double bend =
          row.end_gap - row.gap - courses_.length() * lcp::contact_velocity(path_, row.contact);
      worst = std::max(worst, std::abs(bend - row.bend));
      row.bend = bend;
      row.most_push = std::max(0.0, -end_speed(row, fast_));
      const double parts = row.push() > 0 ? lcp::contact_velocity(fast_, row.contact) - row.most_push : 0;
      worst = std::max(worst, courses_.length() * parts);
      if (!law_.looks_at_bends() || row.arrives) continue;
      const Vec3 bend_of_slip = slip_bend(row);
      worst = std::max(worst, courses_.length() * (bend_of_slip - row.slip_bend).norm());
      row.slip_bend = bend_of_slip;
    }
    const bool patient = round < kPatientRounds || !law_.looks_at_bends();
    if (worst <= (patient ? kClosed : kCloseEnough) * contacts_.margin()) break;
  }
  return worst <= kNearlyClosed * contacts_.margin() ? Result::proved : Result::unproved;
}
// ANCHOR_END: close_ends

// Whether the pushes add more kinetic energy than a plan may borrow until its end takes it back. Bodies that turn a plane by an
// angle of t on a path borrow t^2 / 4 of theirs. And whether those that turn freely would gain at the end, where their spins
// change as if nobody had pushed them.
bool PlanMaker::gains() const {
  double gain = 0, size = 0, end_gain = 0;
  for (std::size_t i = 0; i < courses_.members.size(); ++i) {
    if (!courses_.members[i].dynamic) continue;
    RigidBody free = courses_.members[i].state, fast = fast_[i];
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
  for (const Row& row : rows_) gain -= lcp::kinematic_work(fast_, row.contact, row.impulse);
  return std::max(gain, end_gain) > kMostBorrowed * size;
}

// Up to which time (s) impulses of contacts that last can act evenly.
double PlanMaker::holds_until() {
  contact_list_.clear();
  bends_.clear();
  impulses_.clear();
  for (const Row& row : rows_) {
    if (row.arrives) continue;
    contact_list_.push_back(row.contact);
    bends_.push_back(row.slip_bend);
    impulses_.push_back(row.impulse);
  }
  std::vector<RigidBody> now;
  for (const Member& member : courses_.members) now.push_back(member.state);
  return law_.holds_until(set_of(fast_), now, impulses_, courses_.length());
}

// When (s from the start) a point of a pair has come down to the rest gap, if its bodies go as on these paths.
double PlanMaker::arrival(const Row& row) const {
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

// The points that an unproved pair has at the end of its path become rows; whether there are new ones. One that comes in fast
// there is an event instead, but for the next faces of a mesh that is in contact.
bool PlanMaker::add_rows_of(const world::World& world, int candidate) {
  const Candidate pair = courses_.candidates[at(candidate)];
  const Path &a = courses_.paths[at(pair.a)], &b = courses_.paths[at(pair.b)];
  const bool may_meet = !pair.in_contact || Contacts::convex(world, *pair.contacts);
  double gap = 0;
  bool any = false;
  for (const ContactPoint& point : contacts_.points_at(world, *pair.contacts, a.end, b.end, gap)) {
    const bool known = std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) {
      return row.pair == candidate && row.point.is_same(point, contacts_.margin());
    });
    if (known) continue;
    add_row(world, candidate, point, true);
    Row& row = rows_.back();
    const double end_gap = point.gap_at(a.end, b.end);
    if (may_meet && end_speed(row, path_) < -options_.rest_speed) {
      const double there = pair.in_contact ? arrival(row) : pair.time;
      if (there <= pair.time)
        meeting_ = std::min(meeting_, there);  // else something else is first: a shorter plan
      rows_.pop_back();
      continue;
    }
    row.bend = end_gap - row.gap - courses_.length() * lcp::contact_velocity(path_, row.contact);
    any = true;
  }
  return any;
}

// For the next plan's guess; and which contacts last: where something pushes, all points that stay in contact.
void PlanMaker::remember() const {
  std::vector<char> pushes(courses_.candidates.size(), 0);
  for (const Row& row : rows_) pushes[at(row.pair)] |= row.push() > 0 && !row.arrives;
  for (const Row& row : rows_)
    for (ContactPoint& point : courses_.candidates[at(row.pair)].contacts->points) {
      if (point.key != row.point.key) continue;
      point.force = row.impulse / courses_.length();
      point.lasts = pushes[at(row.pair)] && !row.arrives && row.end_gap <= contacts_.margin();
    }
}

// The members as their contacts that last make them alone, and the impulses (N s) that these need for it.
std::vector<RigidBody> PlanMaker::without_arrivals(std::vector<Vec3>& early) {
  early.clear();
  for (const Row& row : rows_) early.push_back(row.impulse);
  if (std::none_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.arrives && row.push() > 0; }))
    return fast_;
  std::vector<RigidBody> bodies = courses_.with(courses_.drift);
  std::vector<std::size_t> lasting;
  contact_list_.clear();
  approach_limits_.clear();
  bends_.clear();
  impulses_.clear();
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    early[r] = Vec3::Zero();
    if (rows_[r].arrives) continue;
    lasting.push_back(r);
    contact_list_.push_back(rows_[r].contact);
    approach_limits_.push_back(rows_[r].approach_limit(courses_.length()));
    bends_.push_back(rows_[r].slip_bend);
    impulses_.push_back(rows_[r].impulse);
  }
  if (lasting.empty() || !push(bodies)) return bodies;
  for (std::size_t k = 0; k < lasting.size(); ++k) early[lasting[k]] = impulses_[k];
  return bodies;
}

// Who goes by the plan: whoever is pushed, or ends in contact.
Planned PlanMaker::take() {
  const double length = courses_.length();
  remember();
  Planned result;
  std::vector<Vec3> early;
  std::vector<char> goes(courses_.members.size(), 0);
  const std::vector<RigidBody> free = courses_.with(courses_.drift), ends = without_arrivals(early);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    const bool pushes = row.push() > 0 || early[r].dot(row.contact.normal) > 0;
    if (pushes || row.correction > 0 || row.end_gap < contacts_.margin())
      for (const int member : {row.contact.body_a, row.contact.body_b}) goes[at(member)] = 1;
    if (!pushes) continue;
    ++result.pushing;
    result.kinematic_work += lcp::kinematic_work(fast_, row.contact, row.impulse);
    result.early_work += lcp::kinematic_work(fast_, row.contact, early[r]);
    PlannedRow reported;
    reported.contact = row.contact;
    reported.impulse = row.impulse;
    reported.early = early[r];
    reported.before = lcp::relative_velocity(free, row.contact);
    reported.after = lcp::relative_velocity(fast_, row.contact);
    reported.key = row.point.key;
    reported.arrives = row.arrives;
    if (row.arrives) {
      reported.contact.gap = row.end_gap;
      reported.contact.point = row.point.middle(courses_.paths[at(row.contact.body_a)].end,
                                                courses_.paths[at(row.contact.body_b)].end);
    }
    reported.contact.body_a = courses_.members[at(row.contact.body_a)].number;
    reported.contact.body_b = courses_.members[at(row.contact.body_b)].number;
    result.rows.push_back(reported);
  }
  for (std::size_t i = 0; i < courses_.members.size(); ++i) {
    const RigidBody &path = path_[i], &fast = fast_[i], &end = ends[i];
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

#include "ch05_resting_contact/plan.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/impact.hpp"
#include "ch04_multibody_stepping/sensors.hpp"

namespace fc::resting {
namespace {

// Of what a gap lacks of the rest gap, so much is put right in a plan; gaps below this part of the margin at once.
constexpr double kCorrect = 0.2, kLeastGap = 0.25;
constexpr double kNearRest = 0.999;  // of the rest gap: nothing is put right from here on

// A path is clear if its gap stays above this part of the margin, or half of what it was.
constexpr double kFloor = 1.0 / 64;

// Of the margin: two bodies that come in fast, and bounce, are stopped at half of this gap, as in chapter 4.
constexpr double kStop = 0.25;

// Of the margin: a pair that bounces and comes in fast is no contact yet above this gap.
constexpr double kRoom = 0.55;

// A pair that turns in contact is proved sooner by a shorter plan than by ever smaller steps: so many pairs of nodes are
// looked at, of two convex bodies and of meshes.
constexpr std::int64_t kMostPairs = 1000, kMostPairsOfMeshes = 50'000,
                       kNoMost = std::numeric_limits<std::int64_t>::max();

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

constexpr int kMostProofs = 4;  // rounds in which unproved pairs become rows

// The mean of the spin that turns one orientation into another in a time.
Vec3 mean_spin(const Mat3& from, const Mat3& to, double time) {
  const Eigen::AngleAxisd turn(to * from.transpose());
  return turn.angle() / time * turn.axis();
}

}  // namespace

void PlanMaker::start(const world::World& world, const Island& island, double now) {
  ++number_;
  for (const Member& member : members_) place_of_[at(member.number)] = -1;
  place_of_.resize(world.bodies.size(), -1);
  members_ = island.members;
  const std::size_t count = members_.size();
  for (std::size_t i = 0; i < count; ++i) place_of_[at(members_[i].number)] = static_cast<int>(i);
  drift_.assign(count, {});
  last_.assign(count, {});
  fast_.clear();
  tracks_.assign(count, {});
  shares_.assign(count, 1);
  planned_.assign(count, 0);
  pushed_.assign(count, 0);
  changed_.assign(count, 1);
  rows_.clear();
  candidates_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Member& member = members_[i];
    fast_.push_back(member.state);
    if (!member.dynamic) {
      tracks_[i] = track_of(world, member.number, now, length_);
      fast_[i].velocity = tracks_[i].motion.velocity;
      fast_[i].spin = tracks_[i].motion.spin;
      continue;
    }
    ca::Motion flight = world.motion(member.number, now);
    flight.position = Vec3::Zero();  // so that no digits are lost to where it is
    Twist& u = drift_[i];
    u.linear = flight.drag == 0 ? Vec3(flight.velocity + 0.5 * length_ * flight.acceleration)
                                : Vec3(flight.position_at(length_) / length_);
    u.angular = flight.free || flight.spin_drag > 0
                    ? mean_spin(flight.rotation, flight.rotation_at(length_), length_)
                    : flight.spin;
    last_[i] = {flight.velocity_at(length_) - u.linear, flight.spin_at(length_) - u.angular};
  }
  for (const IslandPair& pair : island.pairs) {
    if (comes_in_fast(pair)) continue;
    const int candidate = candidate_of(pair.contacts, pair.a, pair.b);
    candidates_[at(candidate)].in_contact = !pair.contacts->points.empty();
    for (const ContactPoint& point : pair.contacts->points) add_row(world, candidate, point, false);
  }
}

// Whether a pair that bounces comes in fast: it is in the margin, but there is room left.
bool PlanMaker::comes_in_fast(const IslandPair& pair) const {
  if (!options_.exact || pair.contacts->points.empty()) return false;
  const RigidBody &a = members_[at(pair.a)].state, &b = members_[at(pair.b)].state;
  const Pose pose_a = a.pose(), pose_b = b.pose();
  double nearest = std::numeric_limits<double>::infinity(), fastest = 0;
  for (const ContactPoint& point : pair.contacts->points) {
    nearest = std::min(nearest, point.gap_at(pose_a, pose_b));
    const Vec3 middle = point.middle(pose_a, pose_b);
    fastest = std::min(fastest, point.normal_at(pose_a, pose_b).dot(b.velocity_at(middle) - a.velocity_at(middle)));
  }
  return fastest < -options_.rest_speed && nearest > kRoom * contacts_.margin();
}

int PlanMaker::candidate_of(PairContacts* contacts, int a, int b) {
  if (contacts->plan != number_) {
    contacts->plan = number_;
    contacts->place = static_cast<int>(candidates_.size());
    candidates_.push_back({contacts, a, b});
  }
  return contacts->place;
}

void PlanMaker::add_row(const world::World& world, int candidate, const ContactPoint& point, bool arrives) {
  const Candidate& pair = candidates_[at(candidate)];
  const RigidBody &a = members_[at(pair.a)].state, &b = members_[at(pair.b)].state;
  const Pose pose_a = a.pose(), pose_b = b.pose();
  const double rest = 0.5 * contacts_.margin();
  Row row;
  row.pair = candidate;
  row.point = point;
  row.arrives = arrives;
  row.gap = point.gap_at(pose_a, pose_b);
  row.contact = {pair.a, pair.b, point.middle(pose_a, pose_b), point.normal_at(pose_a, pose_b), row.gap, 0,
                 world.turns(members_[at(pair.a)].number), world.turns(members_[at(pair.b)].number)};
  const double gap = arrives ? std::min(pair.contacts->gap, rest) : row.gap;
  row.keep = std::min(gap, rest);
  row.want = gap >= kNearRest * rest ? row.keep
                                     : std::max(gap + kCorrect * (rest - gap), kLeastGap * contacts_.margin());
  row.impulse = arrives ? 0 : point.force * length_;
  rows_.push_back(row);
}

// Steps 1 and 2, with the rows' right-hand sides as they are.
bool PlanMaker::solve() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!members_[i].dynamic) continue;
    fast_[i].velocity = drift_[i].linear;
    fast_[i].spin = drift_[i].angular;
  }
  contact_list_.clear();
  allowed_.clear();
  impulses_.clear();
  for (const Row& row : rows_) {
    contact_list_.push_back(row.contact);
    allowed_.push_back(std::max((row.gap + row.bend - row.keep) / length_, -row.most_push));
    impulses_.push_back(row.impulse);
  }
  const auto solved = [&](std::vector<RigidBody>& bodies) {
    if (rows_.empty()) return true;
    const IslandResult result = solver_.solve(bodies, contact_list_, allowed_, impulses_, options_.solver);
    residual_ = std::max(residual_, result.residual);
    sweeps_ += result.sweeps;
    ++solves_;
    if (!result.solved) status_ = result.status;
    return result.solved;
  };
  if (!solved(fast_)) return false;
  for (std::size_t r = 0; r < rows_.size(); ++r) rows_[r].impulse = impulses_[r];

  path_ = fast_;
  bool short_of = false;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    allowed_[r] = (row.gap + row.bend - row.want) / length_;
    impulses_[r] = row.correction;
    if (lcp::contact_velocity(path_, row.contact) + allowed_[r] < -options_.closed * contacts_.margin() / length_)
      short_of = true;
  }
  if (!short_of) std::fill(impulses_.begin(), impulses_.end(), 0.0);
  if (short_of && !solved(path_)) {  // there is no room for all of it: gaps stay as they are
    path_ = fast_;
    std::fill(impulses_.begin(), impulses_.end(), 0.0);
  }
  for (std::size_t r = 0; r < rows_.size(); ++r) rows_[r].correction = impulses_[r];
  return true;
}

void PlanMaker::follow(int member) {
  const Member& m = members_[at(member)];
  if (!m.dynamic) return;
  const RigidBody& path = path_[at(member)];
  Track& track = tracks_[at(member)];
  if (track.moves && track.velocity == path.velocity && track.spin == path.spin && changed_[at(member)] == 0) return;
  changed_[at(member)] = 1;
  track = straight_track(m.state, path.velocity, path.spin, tracks_[at(member)].reach, length_);
}

// The contact's velocity (m/s) at the end of the paths, with the velocities w.
double PlanMaker::end_speed(const Row& row, const Track& a, const Track& b) const {
  const RigidBody &fast_a = fast_[at(row.contact.body_a)], &fast_b = fast_[at(row.contact.body_b)];
  const Vec3 arm_a = row.point.on_a(a.end, b.end) - a.end.position,
             arm_b = row.point.on_b(a.end, b.end) - b.end.position;
  return row.point.normal_at(a.end, b.end)
      .dot(fast_b.velocity + fast_b.spin.cross(arm_b) - fast_a.velocity - fast_a.spin.cross(arm_a));
}

// Solves until the gaps at the end are what the rows say of them.
// ANCHOR: close_ends
bool PlanMaker::close_ends() {
  for (Row& row : rows_) row.most_push = kNoLimit;
  for (int round = 0; round < options_.most_rounds; ++round) {
    if (!solve()) return false;
    for (int member = 0; member < static_cast<int>(members_.size()); ++member) follow(member);
    double worst = 0;
    for (Row& row : rows_) {
      const Track &a = tracks_[at(row.contact.body_a)], &b = tracks_[at(row.contact.body_b)];
      row.end_gap = row.point.gap_at(a.end, b.end);
      const double push = std::max(0.0, -end_speed(row, a, b));
      const double bend = row.end_gap - row.gap - length_ * lcp::contact_velocity(path_, row.contact);
      const bool matters = row.end_gap < contacts_.margin() || row.impulse > 0 || row.correction > 0;
      if (!matters) continue;
      worst = std::max(worst, std::abs(bend - row.bend));
      row.bend = bend;
      row.most_push = push;
    }
    if (worst <= options_.closed * contacts_.margin()) break;
  }
  return true;
}
// ANCHOR_END: close_ends

// Whether all that push are in contact at the end: no impulse acts across more than the margin.
bool PlanMaker::is_closed() const {
  return std::none_of(rows_.begin(), rows_.end(), [&](const Row& row) {
    return row.impulse > 0 && arrives(row) && row.end_gap > contacts_.margin();
  });
}

bool PlanMaker::is_event(const Candidate& pair) const {
  return !pair.in_contact && options_.exact;
}

double PlanMaker::need(const world::World& world, const Candidate& pair) const {
  const double floor = (is_event(pair) ? kStop : kFloor) * contacts_.margin(), gap = pair.contacts->gap;
  if (gap >= 2 * floor) return floor;
  if (gap > kFloor * world.tolerance) return 0.5 * gap;
  // It started like this, touching: then it need only not become less, but for rounding.
  const ca::PairPose pose(tracks_[at(pair.a)].start, tracks_[at(pair.b)].start);
  return gap - 64 * ca::rounding_term(world.model_of(pair.contacts->a).whole(),
                                      world.model_of(pair.contacts->b).whole(), pose);
}

PathVerdict PlanMaker::check(const world::World& world, Candidate& pair, const Track& a, const Track& b) {
  ++checked_;
  const bool in_order = pair.contacts->a == members_[at(pair.a)].number;
  return check_path(world, contacts_, *pair.contacts, in_order ? a : b, in_order ? b : a, length_, need(world, pair),
                    is_event(pair) ? kNoMost : Contacts::convex(world, *pair.contacts) ? kMostPairs : kMostPairsOfMeshes);
}

// All pairs of members, and of members with what cannot be moved, that may come near each other on their paths.
void PlanMaker::find_candidates(const world::World& world, double now) {
  const int count = static_cast<int>(members_.size());
  std::vector<world::Bounds> boxes(members_.size());
  for (int i = 0; i < count; ++i) {
    const Track& t = tracks_[at(i)];
    const std::size_t shape = at(world.bodies[at(members_[at(i)].number)].shape);
    const double turn = std::min(2.0, t.spin_rate * length_) * t.reach;
    const Vec3 half = (t.start.rotation.cwiseAbs() * world.half_extents[shape]).cwiseMin(Vec3::Constant(t.reach)) +
                      Vec3::Constant(0.5 * contacts_.margin() + turn +
                                     0.125 * length_ * length_ * t.acceleration.norm());
    boxes[at(i)] = {t.start.position.cwiseMin(t.end.position) - half,
                    t.start.position.cwiseMax(t.end.position) + half};
  }
  const auto add = [&](int i, int j) {
    PairContacts& contacts = contacts_.pair(members_[at(i)].number, members_[at(j)].number);
    const std::size_t before = candidates_.size();
    const bool in_order = contacts.a == members_[at(i)].number;
    const int number = candidate_of(&contacts, in_order ? i : j, in_order ? j : i);
    if (at(number) < before) return;
    const Candidate& pair = candidates_[at(number)];
    contacts_.update(world, contacts, tracks_[at(pair.a)].start, tracks_[at(pair.b)].start);
  };
  tree_.build(boxes);
  std::vector<int> others;
  for (int i = 0; i < count; ++i) {
    if (!members_[at(i)].dynamic || !changed_[at(i)]) continue;
    others.clear();
    tree_.overlapping(boxes[at(i)], [&](int j) {
      if (j != i && members_[at(j)].dynamic && (j > i || !changed_[at(j)])) others.push_back(j);
    });
    std::sort(others.begin(), others.end());
    for (const int j : others) add(i, j);
    others.clear();
    world.schedule.overlapping(boxes[at(i)], [&](int other) {
      if (!world.yields(other) && !world::is_sensor_pair(world, members_[at(i)].number, other))
        others.push_back(other);
    });
    std::sort(others.begin(), others.end());
    for (const int other : others) {
      int place = place_of_[at(other)];
      if (place < 0) {
        place = static_cast<int>(members_.size());
        RigidBody state = world.state_at(other, now);
        tracks_.push_back(track_of(world, other, now, length_));
        state.velocity = tracks_.back().motion.velocity;
        state.spin = tracks_.back().motion.spin;
        members_.push_back({other, state, false});
        place_of_[at(other)] = place;
        fast_.push_back(state);
        path_.push_back(state);
        drift_.emplace_back();
        last_.emplace_back();
        shares_.push_back(1);
        planned_.push_back(0);
        pushed_.push_back(0);
        changed_.push_back(0);
      }
      add(i, place);
    }
  }
}

// Step 3: whether all paths are clear; the others are in unproved().
bool PlanMaker::prove(const world::World& world) {
  unproved_.clear();
  for (Candidate& pair : candidates_) {
    if (changed_[at(pair.a)] || changed_[at(pair.b)]) {
      const PathVerdict verdict = check(world, pair, tracks_[at(pair.a)], tracks_[at(pair.b)]);
      pair.clear = verdict.clear;
      pair.time = verdict.time;
    }
    if (!pair.clear) unproved_.push_back({pair.a, pair.b, pair.time / length_});
  }
  std::fill(changed_.begin(), changed_.end(), 0);
  return unproved_.empty();
}

// The points that an unproved pair has at the end of its path become rows; whether there are new ones.
bool PlanMaker::add_rows_of(const world::World& world, int candidate) {
  Candidate& pair = candidates_[at(candidate)];
  const Track &a = tracks_[at(pair.a)], &b = tracks_[at(pair.b)];
  double gap = 0;
  bool any = false;
  for (const ContactPoint& point : contacts_.points_at(world, *pair.contacts, a.end, b.end, gap)) {
    const bool known = std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) {
      return row.pair == candidate && row.point.key == point.key && row.point.of_b == point.of_b &&
             (row.point.local_normal - point.local_normal).norm() < 1e-6 &&
             (row.point.a.local - point.a.local).norm() + (row.point.b.local - point.b.local).norm() < contacts_.margin();
    });
    if (known) continue;
    if (is_event(pair)) {
      const Vec3 normal = point.normal_at(a.end, b.end), arm_a = point.on_a(a.end, b.end) - a.end.position,
                 arm_b = point.on_b(a.end, b.end) - b.end.position;
      const double speed = normal.dot(b.velocity + b.spin.cross(arm_b) - a.velocity - a.spin.cross(arm_a));
      if (speed < -options_.rest_speed) {
        meeting_ = std::min(meeting_, pair.time);
        continue;
      }
    }
    add_row(world, candidate, point, true);
    Row& row = rows_.back();
    row.bend = point.gap_at(a.end, b.end) - row.gap - length_ * lcp::contact_velocity(path_, row.contact);
    any = true;
  }
  return any;
}

PlanMaker::Result PlanMaker::make(const world::World& world, const Island& island, double now, double length,
                                  const PlanOptions& options) {
  options_ = options;
  length_ = length;
  residual_ = correction_ = 0;
  solves_ = sweeps_ = checked_ = 0;
  start(world, island, now);
  for (std::size_t i = 0; i < members_.size(); ++i)
    tracks_[i].reach = world.shapes[at(world.bodies[at(members_[i].number)].shape)].reach;
  Result result = Result::unproved;
  for (int round = 0; round < kMostProofs; ++round) {
    if (!close_ends()) return Result::unsolved;
    find_candidates(world, now);
    const bool clear = prove(world);
    if (!is_closed()) break;
    if (clear) {
      result = Result::proved;
      break;
    }
    bool any = false;
    meeting_ = length_;
    for (int i = 0; i < static_cast<int>(candidates_.size()); ++i)
      if (!candidates_[at(i)].clear && add_rows_of(world, i)) any = true;
    if (meeting_ < length_) {
      result = Result::meets;
      break;
    }
    if (!any) break;
  }
  settle();
  return result;
}

// Who goes by the plan: whoever is pushed, or ends in contact.
void PlanMaker::settle() {
  for (const Row& row : rows_) {
    const bool pushes = row.impulse > 0 || row.correction > 0;
    for (const int member : {row.contact.body_a, row.contact.body_b}) {
      if (!members_[at(member)].dynamic) continue;
      if (pushes) pushed_[at(member)] = 1;
      if (pushes || row.end_gap < contacts_.margin()) planned_[at(member)] = 1;
    }
  }
  arrivals_.assign(members_.size(), {});
  for (const Row& row : rows_) {
    if (!(row.impulse > 0) || !arrives(row)) continue;
    for (const bool is_a : {true, false}) {
      const int member = is_a ? row.contact.body_a : row.contact.body_b;
      const RigidBody& body = members_[at(member)].state;
      if (body.is_static()) continue;
      const Vec3 push = (is_a ? -row.impulse : row.impulse) * row.contact.normal;
      Twist& arrival = arrivals_[at(member)];
      arrival.linear += body.inverse_mass * push.cwiseProduct(body.free_moves);
      if (is_a ? row.contact.turns_a : row.contact.turns_b)
        arrival.angular += body.inverse_inertia_world() * (row.contact.point - body.position).cross(push);
    }
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Vec3 linear = path_[i].velocity - fast_[i].velocity, angular = path_[i].spin - fast_[i].spin;
    correction_ = std::max(correction_, length_ * (linear.norm() + tracks_[i].reach * angular.norm()));
  }
}

// ANCHOR: plan_of
world::Plan PlanMaker::plan_of(int member) const {
  const std::size_t i = at(member);
  world::Plan plan;
  plan.linear = shares_[i] * path_[i].velocity;
  plan.angular = shares_[i] * path_[i].spin;
  const Vec3 linear = shares_[i] * (fast_[i].velocity + last_[i].linear) - arrivals_[i].linear,
             angular = shares_[i] * (fast_[i].spin + last_[i].angular) - arrivals_[i].angular;
  plan.push = (linear - members_[i].state.velocity) / length_;
  plan.turn = (angular - members_[i].state.spin) / length_;
  return plan;
}
// ANCHOR_END: plan_of

std::vector<PlannedRow> PlanMaker::rows() const {
  std::vector<PlannedRow> rows;
  std::vector<RigidBody> drifting = fast_;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!members_[i].dynamic) continue;
    drifting[i].velocity = drift_[i].linear;
    drifting[i].spin = drift_[i].angular;
  }
  for (const Row& row : rows_) {
    if (!(row.impulse > 0)) continue;
    PlannedRow told;
    told.contact = row.contact;
    told.contact.body_a = members_[at(row.contact.body_a)].number;
    told.contact.body_b = members_[at(row.contact.body_b)].number;
    told.impulse = row.impulse;
    told.before = lcp::contact_velocity(drifting, row.contact);
    told.after = lcp::contact_velocity(fast_, row.contact);
    told.arrives = arrives(row);
    told.key = row.point.key;
    if (told.arrives) {
      const Track &a = tracks_[at(row.contact.body_a)], &b = tracks_[at(row.contact.body_b)];
      told.contact.gap = row.end_gap;
      told.contact.point = row.point.middle(a.end, b.end);
    }
    // For the next plan's guess.
    for (ContactPoint& point : candidates_[at(row.pair)].contacts->points)
      if (point.key == row.point.key) {
        point.force = row.impulse / length_;
        point.lasts = !told.arrives;
      }
    rows.push_back(told);
  }
  return rows;
}

double PlanMaker::kinematic_work() const {
  double work = 0;
  for (const Row& row : rows_)
    if (row.impulse > 0) work += lcp::kinematic_work(fast_, row.contact, row.impulse);
  return work;
}

double PlanMaker::shorten(const world::World& world, int& count) {
  const auto scaled = [&](int member) {
    const Member& m = members_[at(member)];
    if (!m.dynamic) return tracks_[at(member)];
    const double share = shares_[at(member)];
    return straight_track(m.state, share * path_[at(member)].velocity, share * path_[at(member)].spin,
                          tracks_[at(member)].reach, length_);
  };
  blocked_.clear();
  std::vector<char> waiting(candidates_.size(), 1);
  for (std::size_t i = 0; i < candidates_.size(); ++i) waiting[i] = !candidates_[i].clear;
  constexpr double kOfFree = 0.9, kLeastShare = 1e-3;
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (!waiting[i]) continue;
      waiting[i] = 0;
      Candidate& pair = candidates_[i];
      double &share_a = shares_[at(pair.a)], &share_b = shares_[at(pair.b)];
      const double before_a = share_a, before_b = share_b;
      for (;;) {
        const PathVerdict verdict = check(world, pair, scaled(pair.a), scaled(pair.b));
        if (verdict.clear) break;
        const bool dynamic_a = members_[at(pair.a)].dynamic, dynamic_b = members_[at(pair.b)].dynamic;
        const double part = kOfFree * verdict.time / length_;
        // Both take the smaller share first: together they move as they would, but slower.
        double share = std::min(dynamic_a ? share_a : 1.0, dynamic_b ? share_b : 1.0);
        if ((!dynamic_a || share_a == share) && (!dynamic_b || share_b == share)) share *= part;
        if (share < kLeastShare) share = 0;
        if ((!dynamic_a || share_a == share) && (!dynamic_b || share_b == share)) {  // a kinematic body comes
          for (const int member : {pair.a, pair.b})
            if (!members_[at(member)].dynamic && tracks_[at(member)].moves)
              blocked_.push_back(members_[at(member)].number);
          break;
        }
        if (dynamic_a) share_a = std::min(share_a, share);
        if (dynamic_b) share_b = std::min(share_b, share);
      }
      if (share_a == before_a && share_b == before_b) continue;
      more = true;
      for (std::size_t k = 0; k < candidates_.size(); ++k) {
        const Candidate& other = candidates_[k];
        if (k != i && ((share_a != before_a && (other.a == pair.a || other.b == pair.a)) ||
                       (share_b != before_b && (other.a == pair.b || other.b == pair.b))))
          waiting[k] = 1;
      }
    }
  }
  double lost = 0;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!members_[i].dynamic || shares_[i] == 1) continue;
    ++count;
    lost += (1 - shares_[i]) * members_[i].state.mass * (fast_[i].velocity + last_[i].linear).norm();
    planned_[i] = 1;
  }
  return lost;
}

}  // namespace fc::resting

#include "ch05_resting_contact/pile.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {
namespace {

// A path is clear if its gap stays above this part of the margin, or half of what it was.
constexpr double kPathFloor = 1.0 / 64;

// The largest part of their kinetic energy that a pile's plans may add to it in a frame.
constexpr double kMostGained = 0.01;

// A pile that settles is swept until this residual is reached, or so many rows were looked at.
constexpr double kSettled = 2e-4;
constexpr int kMostVisits = 150'000;

// Pairs of nodes that are looked at in one proof.
constexpr std::int64_t kMostNodePairs = 50'000;

// Of the time until two come near: so far they go. And what is less than this share is nothing.
constexpr double kOfFree = 0.9, kLeastShare = 1e-3;

// Finds shares of the paths of a pile with which no body is in the way of another.
class Shortening {
 public:
  Shortening(const world::World& world, Courses& courses, std::vector<double>& shares,
             std::vector<int>& blocked)
      : world_(world),
        courses_(courses),
        shares_(shares),
        blocked_(blocked),
        pairs_of_(courses.members.size()) {}

  void run(double floor) {
    if (std::all_of(courses_.candidates.begin(), courses_.candidates.end(),
                    [](const Candidate& c) { return c.clear; }))
      return;
    const int count = static_cast<int>(courses_.candidates.size());
    std::vector<char> waits(courses_.candidates.size(), 0);
    std::vector<int> waiting;
    for (int i = 0; i < count; ++i) {
      const Candidate& pair = courses_.candidates[at(i)];
      if (!pair.clear) waiting.push_back(i);
      waits[at(i)] = !pair.clear;
      pairs_of_[at(pair.a)].push_back(i);
      pairs_of_[at(pair.b)].push_back(i);
    }
    for (std::size_t next = 0; next < waiting.size(); ++next) {
      const int i = waiting[next];
      waits[at(i)] = 0;
      const Candidate& pair = courses_.candidates[at(i)];
      const double a = shares_[at(pair.a)], b = shares_[at(pair.b)];
      take(pair, floor);
      for (const int member : {pair.a, pair.b}) {
        if (shares_[at(member)] == (member == pair.a ? a : b)) continue;
        for (const int other : pairs_of_[at(member)]) {
          if (other == i || waits[at(other)]) continue;
          waits[at(other)] = 1;
          waiting.push_back(other);
        }
      }
    }
    for (int i = 0; i < static_cast<int>(shares_.size()); ++i) courses_.paths[at(i)] = scaled(i);
  }

 private:
  Path scaled(int member) const {
    const Path& path = courses_.paths[at(member)];
    const double share = shares_[at(member)];
    if (share == 1) return path;
    return straight_path(courses_.members[at(member)].state, share * path.velocity, share * path.spin,
                         path.reach, courses_.length());
  }

  // Lowers the shares of the two until their paths are clear: the larger one first, at most to the smaller; then both alike,
  // since together they move as they would, but slower.
  void take(const Candidate& pair, double floor) {
    const bool dynamic_a = courses_.members[at(pair.a)].dynamic,
               dynamic_b = courses_.members[at(pair.b)].dynamic;
    double &share_a = shares_[at(pair.a)], &share_b = shares_[at(pair.b)];
    for (;;) {
      const PathVerdict verdict =
          courses_.check(world_, pair, scaled(pair.a), scaled(pair.b),
                         {.required_gap = floor, .most_pairs = kMostNodePairs, .by_planes = true});
      if (verdict.clear) return;
      const double part = kOfFree * verdict.time / courses_.length();
      const auto lower = [&](double share, double least) {
        const double lowered = std::max(part * share, least);
        return lowered < kLeastShare ? 0 : lowered;
      };
      if (dynamic_a && dynamic_b && share_a != share_b) {
        double& larger = share_a > share_b ? share_a : share_b;
        larger = lower(larger, std::min(share_a, share_b));
        continue;
      }
      const double before_a = share_a, before_b = share_b;
      if (dynamic_a) share_a = lower(share_a, 0);
      if (dynamic_b) share_b = lower(share_b, 0);
      if (share_a != before_a || share_b != before_b) continue;
      for (const int member : {pair.a, pair.b})  // they stand, and a kinematic body goes into one
        if (!courses_.members[at(member)].dynamic && courses_.paths[at(member)].moves)
          blocked_.push_back(courses_.members[at(member)].number);
      return;
    }
  }

  const world::World& world_;
  Courses& courses_;
  std::vector<double>& shares_;
  std::vector<int>& blocked_;
  std::vector<std::vector<int>> pairs_of_;
};

}  // namespace

Planned PilePlanner::make(const world::World& world, std::span<const Member> members, double now,
                          double length, const PileOptions& options) {
  options_ = options;
  rows_.clear();
  late_.clear();
  blocked_.clear();
  lost_ = 0;
  shortened_ = 0;
  gauss_seidel_->clear();
  courses_.start(world, members, now, length);
  courses_.find(world, true);
  add_bodies();
  first_row_.assign(courses_.candidates.size(), -1);
  for (int i = 0; i < static_cast<int>(courses_.candidates.size()); ++i) {
    courses_.fetch_ahead(at(i));
    add_pair(world, i);
  }
  swept_ = gauss_seidel_->run(std::max(options_.sweeps, options_.visits / (1 + rows())));
  while (options_.settles && swept_ * rows() < kMostVisits && gauss_seidel_->residual() > kSettled)
    swept_ += gauss_seidel_->run(options_.sweeps);
  find_paths(world);
  shares_.assign(courses_.members.size(), 1);
  Shortening(world, courses_, shares_, blocked_).run(kPathFloor * contacts_.margin());
  drop_what_acts_on_air();
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    if (shares_[i] == 1) continue;
    ++shortened_;
    lost_ += (1 - shares_[i]) * courses_.members[i].state.mass * velocities_[i].linear.norm();
  }
  return take(world);
}

double PilePlanner::smallest_gap() const {
  double gap = std::numeric_limits<double>::infinity();
  for (const Candidate& pair : courses_.candidates)
    if (pair.contacts->gap <= contacts_.margin()) gap = std::min(gap, pair.contacts->gap);
  return gap;
}

// A member's, at the end.
Twist PilePlanner::free_velocities(std::size_t i) const {
  const Twist &mean = courses_.drift[i], &more = courses_.last[i];
  return {mean.linear + more.linear, mean.angular + more.angular};
}

// Members that the sweeps have not heard of.
void PilePlanner::add_bodies() {
  for (std::size_t i = at(gauss_seidel_->bodies()); i < courses_.members.size(); ++i) {
    gauss_seidel_->add_body(courses_.members[i].state, free_velocities(i), courses_.drift[i]);
  }
}

lcp::Contact PilePlanner::contact_of(const world::World& world, const Row& row) const {
  const Candidate& pair = courses_.candidates[at(row.pair)];
  const Pose &a = courses_.paths[at(pair.a)].start, &b = courses_.paths[at(pair.b)].start;
  const ContactPoint& point = point_of(row);
  const Vec3 normal = point.normal_at(a, b), on_a = point.a.at(a, normal), on_b = point.b.at(b, -normal);
  return {pair.a,
          pair.b,
          0.5 * (on_a + on_b),
          normal,
          normal.dot(on_b - on_a),
          0,
          world.turns(courses_.members[at(pair.a)].number),
          world.turns(courses_.members[at(pair.b)].number)};
}

// All rows of a pair are there, from `first` on.
void PilePlanner::end_pair(int candidate, int first) {
  if (first == rows()) return;
  const PairContacts& pair = *courses_.candidates[at(candidate)].contacts;
  guesses_.clear();
  for (int i = first; i < rows(); ++i)
    guesses_.push_back(rows_[at(i)].late ? Vec3(Vec3::Zero())
                                         : Vec3(courses_.length() * point_of(rows_[at(i)]).force));
  gauss_seidel_->end_pair(first, pair.a, pair.b, guesses_);
}

// Its rows, of the points that it has at the start. Most share one normal.
void PilePlanner::add_pair(const world::World& world, int candidate) {
  const Candidate& pair = courses_.candidates[at(candidate)];
  const std::vector<ContactPoint>& points = pair.contacts->points;
  if (points.empty()) return;
  const Pose &a = courses_.paths[at(pair.a)].start, &b = courses_.paths[at(pair.b)].start;
  lcp::Contact contact;
  contact.body_a = pair.a;
  contact.body_b = pair.b;
  contact.turns_a = world.turns(pair.contacts->a);
  contact.turns_b = world.turns(pair.contacts->b);
  const int first = rows();
  for (std::size_t place = 0; place < points.size(); ++place) {
    const ContactPoint& point = points[place];
    const ContactPoint& last = points[place == 0 ? 0 : place - 1];
    if (place == 0 || point.balls || point.of_b != last.of_b || point.local_normal != last.local_normal)
      contact.normal = point.normal_at(a, b);
    const Vec3 on_a = point.a.at(a, contact.normal), on_b = point.b.at(b, -contact.normal);
    contact.point = 0.5 * (on_a + on_b);
    contact.gap = contact.normal.dot(on_b - on_a);
    add_row(contact, candidate, static_cast<int>(place), false);
  }
  end_pair(candidate, first);
}

int PilePlanner::add_row(const lcp::Contact& contact, int candidate, int place, bool late) {
  Row row{candidate, place, first_row_[at(candidate)], 0, late, late};
  const double margin = contacts_.margin(), length = courses_.length();
  row.arrives = late || contact.gap > margin;
  const double guess = late ? 0 : contact.normal.dot(point_of(row).force) * length;
  const int number =
      gauss_seidel_->add(contact, std::max(0.0, contact.gap - 0.5 * margin) / length,
                         (contact.gap - wanted_gap(contact.gap, margin)) / length, guess, 0.5 * guess);
  row.before = gauss_seidel_->start_speed(number);
  first_row_[at(candidate)] = number;
  rows_.push_back(row);
  return number;
}

// Step 2.
void PilePlanner::find_paths(const world::World& world) {
  const double floor = kPathFloor * contacts_.margin();
  for (int round = 0;; ++round) {
    gauss_seidel_->work_out_paths(paths_);
    for (std::size_t i = 0; i < paths_.size(); ++i) courses_.go(static_cast<int>(i), paths_[i]);
    courses_.find(world, true);
    add_bodies();
    first_row_.resize(courses_.candidates.size(), -1);
    const PathOptions options{
        .required_gap = floor, .most_pairs = kMostNodePairs, .by_planes = true, .whole = true};
    const bool clear = courses_.prove(world, [&](const Candidate&) { return options; });
    if (clear || round == options_.rounds) return;
    for (int i = 0; i < static_cast<int>(courses_.candidates.size()); ++i)
      if (!courses_.candidates[at(i)].clear) look_again(world, i);
    swept_ += gauss_seidel_->run(std::max(options_.path_sweeps, options_.visits / (1 + rows())));
  }
}

// Rows of a pair whose paths are not clear: with the gaps at the end as they will be, and with all points that it has there.
void PilePlanner::look_again(const world::World& world, int candidate) {
  const Candidate pair = courses_.candidates[at(candidate)];
  const Path &a = courses_.paths[at(pair.a)], &b = courses_.paths[at(pair.b)];
  const double rest = 0.5 * contacts_.margin();
  const auto correct = [&](int row) {
    const double gap = point_of(rows_[at(row)]).gap_at(a.end, b.end);
    gauss_seidel_->set_room(row, (gap - rest) / courses_.length() - gauss_seidel_->path_speed(row));
  };
  for (int row = first_row_[at(candidate)]; row >= 0; row = rows_[at(row)].next) correct(row);
  double gap = 0;
  const int first = rows();
  for (const ContactPoint& point : contacts_.points_at(world, *pair.contacts, a.end, b.end, gap)) {
    bool known = false;
    for (int row = first_row_[at(candidate)]; row >= 0 && !known; row = rows_[at(row)].next)
      known = point_of(rows_[at(row)]).is_same(point, contacts_.margin());
    if (known) continue;
    late_.push_back(point);
    const int place = static_cast<int>(late_.size()) - 1;
    correct(add_row(contact_of(world, {candidate, place, -1, 0, true, true}), candidate, place, true));
  }
  end_pair(candidate, first);
}

// An impulse at the end of a path needs a contact there.
void PilePlanner::drop_what_acts_on_air() {
  constexpr int kMostTimes = 3, kSweeps = 4;
  for (int times = 0; times < kMostTimes; ++times) {
    bool any = false;
    for (int i = 0; i < rows(); ++i) {
      const Row& row = rows_[at(i)];
      if (!row.arrives || !(gauss_seidel_->impulse(i) > 0)) continue;
      const Candidate& pair = courses_.candidates[at(row.pair)];
      const double gap = point_of(row).gap_at(courses_.paths[at(pair.a)].end, courses_.paths[at(pair.b)].end);
      if (gap <= contacts_.margin()) continue;
      gauss_seidel_->drop(i);
      any = true;
    }
    if (!any) break;
    if (times + 1 < kMostTimes) swept_ += gauss_seidel_->run_velocities(kSweeps);
  }
  gauss_seidel_->work_out_velocities(velocities_);
}

// What bounces gives back what its restitution says, with the largest factor <= 1 for all with which this takes no more energy
// than the impulses gave (see impact_law.hpp).
void PilePlanner::give_back(const world::World& world, std::vector<RigidBody>& bodies) {
  back_.assign(rows_.size(), 0);
  bool any = false;
  for (int i = 0; i < rows(); ++i) {
    const Row& row = rows_[at(i)];
    const PairContacts& pair = *courses_.candidates[at(row.pair)].contacts;
    if (row.before >= -contacts_.margin() / options_.frame || point_of(row).lasts) continue;
    back_[at(i)] = gauss_seidel_->impulse(i) * world.restitution_of(pair.a, pair.b);
    any = any || back_[at(i)] > 0;
  }
  if (!any) return;
  std::vector<RigidBody> bounced = bodies;
  for (int i = 0; i < rows(); ++i)
    if (back_[at(i)] > 0) lcp::apply_impulse(bounced, contact_of(world, rows_[at(i)]), back_[at(i)]);
  double gave = 0, takes = 0;  // z'Az and r'Ar, by what the impulses do to the velocities
  for (int i = 0; i < rows(); ++i) {
    const double z = gauss_seidel_->impulse(i);
    if (!(z > 0)) continue;
    const lcp::Contact contact = contact_of(world, rows_[at(i)]);
    const double end = lcp::contact_velocity(bodies, contact);
    gave += z * (end - rows_[at(i)].before);
    takes += back_[at(i)] * (lcp::contact_velocity(bounced, contact) - end);
  }
  const double cap = takes > gave ? std::sqrt(std::max(0.0, gave) / takes) : 1;
  for (int i = 0; i < rows(); ++i) {
    back_[at(i)] *= cap;
    if (back_[at(i)] > 0) lcp::apply_impulse(bodies, contact_of(world, rows_[at(i)]), back_[at(i)]);
  }
}

// For the next plan's guess; and which contacts last: where something pushes, all points.
void PilePlanner::remember() const {
  std::vector<char> pushes(courses_.candidates.size(), 0);
  for (int i = 0; i < rows(); ++i)
    pushes[at(rows_[at(i)].pair)] |= gauss_seidel_->impulse(i) > 0 && !rows_[at(i)].arrives;
  for (int i = 0; i < rows(); ++i) {
    const Row& row = rows_[at(i)];
    if (row.late) continue;
    ContactPoint& point = courses_.candidates[at(row.pair)].contacts->points[at(row.place)];
    point.force = gauss_seidel_->whole_impulse(i) / courses_.length();
    point.lasts = pushes[at(row.pair)] && !row.arrives;
  }
}

// What the rows did. swept, bounced: the members at the end, before and after they give back.
void PilePlanner::report_rows(const world::World& world, std::span<const RigidBody> swept,
                              std::span<const RigidBody> bounced, Planned& result) const {
  std::vector<Twist> without;
  for (std::size_t i = 0; i < courses_.members.size(); ++i) without.push_back(free_velocities(i));
  const std::vector<RigidBody> free = courses_.with(without);
  for (int i = 0; i < rows(); ++i) {
    const Row& row = rows_[at(i)];
    const Candidate& pair = courses_.candidates[at(row.pair)];
    if (!(gauss_seidel_->impulse(i) > 0)) continue;
    PlannedRow reported;
    reported.contact = contact_of(world, row);
    reported.impulse = gauss_seidel_->whole_impulse(i);
    reported.back = back_[at(i)] * reported.contact.normal;
    if (world.is_moving_kinematic(pair.contacts->a) || world.is_moving_kinematic(pair.contacts->b))
      result.kinematic_work +=
          lcp::kinematic_work(swept, reported.contact, Vec3(reported.impulse + reported.back));
    if (!options_.report_rows) continue;
    reported.before = lcp::relative_velocity(free, reported.contact);
    reported.after = lcp::relative_velocity(bounced, reported.contact);
    reported.key = point_of(row).key;
    reported.patch = gauss_seidel_->patch_of(i);
    reported.arrives = row.arrives;
    if (row.arrives) {
      const Path &a = courses_.paths[at(pair.a)], &b = courses_.paths[at(pair.b)];
      reported.contact.gap = point_of(row).gap_at(a.end, b.end);
      reported.contact.point = point_of(row).middle(a.end, b.end);
    }
    reported.contact.body_a = pair.contacts->a;
    reported.contact.body_b = pair.contacts->b;
    result.rows.push_back(reported);
  }
}

// All impulses act at the end.
Planned PilePlanner::take(const world::World& world) {
  std::vector<RigidBody> bodies = courses_.with(velocities_);
  Planned result;
  const bool any_kinematic =
      std::any_of(courses_.members.begin(), courses_.members.end(),
                  [&](const Member& m) { return world.is_moving_kinematic(m.number); });
  const bool reports = options_.report_rows || any_kinematic;
  const std::vector<RigidBody> swept = reports ? bodies : std::vector<RigidBody>{};
  give_back(world, bodies);
  remember();
  if (reports) report_rows(world, swept, bodies, result);
  for (int i = 0; i < rows(); ++i) result.pushing += gauss_seidel_->impulse(i) > 0;
  double gained = -result.kinematic_work, size = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Member& member = courses_.members[i];
    if (!member.dynamic) continue;
    const Path& path = courses_.paths[i];
    const double share = shares_[i];  // of what it has at the end, too
    const Twist without = free_velocities(i);
    result.bodies.push_back(member.number);
    result.motions.push_back(planned_motion(member, {path.velocity, path.spin}, without, courses_.length()));
    result.arrivals.push_back(
        {share * bodies[i].velocity - without.linear, share * bodies[i].spin - without.angular});
    const double before = member.state.kinetic_energy(), slow = contacts_.margin() / courses_.length();
    gained += share * share * bodies[i].kinetic_energy() - before;
    if (world.effects.gravity)
      gained -= member.state.mass * world.effects.gravity->dot(path.end.position - path.start.position);
    size += before + 0.5 * member.state.mass * slow * slow;
  }
  gains_ = gained > kMostGained * size * courses_.length() / options_.frame;
  return result;
}

}  // namespace fc::resting

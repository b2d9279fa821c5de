#include "ch05_resting_contact/pile.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/impact.hpp"

namespace fc::resting {
namespace {

// A path is clear if its gap stays above this part of the margin, or half of what it was.
constexpr double kPathFloor = 1.0 / 64;

// The largest share of their kinetic energy that a pile's plans may add to it in a frame.
constexpr double kMostGained = 0.01;

// A pile settles when its bodies are slower than this many margins in a frame. Then it is swept down to this residual.
constexpr double kSettles = 1.0 / 4, kSettled = 1e-4;

// Pairs of nodes that one proof may examine.
constexpr std::int64_t kMostNodePairs = 50'000;

// Bodies go this share of the way until two come near. A share below the second number counts as nothing.
constexpr double kOfFree = 0.9, kLeastShare = 1e-3;

// Finds shares of the paths of a pile for which no body is in another's way.
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

  // Lowers the shares of the two bodies until their paths are clear. First the larger share, at most to the smaller
  // one; then both together, so that the two move as they would, but more slowly.
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
      for (const int member : {pair.a, pair.b})  // they stop, and a kinematic body runs into one
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
  blocked_.clear();
  lost_ = 0;
  shortened_ = 0;
  courses_.start(world, members, now, length);
  times_ = {};
  search(world);
  swept_ = sweep(sweeps(options_.sweeps));
  if (are_slow(members, kSettles * contacts_.margin() / options_.frame))
    while (swept_ * rows() < options_.settling_visits && gauss_seidel_->residual() > kSettled)
      swept_ += sweep(options_.sweeps);
  find_paths(world);
  shorten(world);
  swept_ += rows_.drop_what_acts_on_air();
  gauss_seidel_->work_out_velocities(velocities_);
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    if (shares_[i] == 1) continue;
    ++shortened_;
    lost_ += (1 - shares_[i]) * courses_.members[i].state.mass * velocities_[i].linear.norm();
  }
  return take(world);
}

// The pairs of the pile, their contacts, and a row for each.
void PilePlanner::search(const world::World& world) {
  const TimeInto time(times_.contacts_ns);
  courses_.find(world, true);
  rows_.start(world);
}

int PilePlanner::sweep(int count) {
  const TimeInto time(times_.solver_ns);
  return gauss_seidel_->run(count);
}

// Step 3.
void PilePlanner::shorten(const world::World& world) {
  const TimeInto time(times_.proofs_ns);
  shares_.assign(courses_.members.size(), 1);
  Shortening(world, courses_, shares_, blocked_).run(kPathFloor * contacts_.margin());
}

// Step 2.
void PilePlanner::find_paths(const world::World& world) {
  const double floor = kPathFloor * contacts_.margin();
  for (int round = 0;; ++round) {
    gauss_seidel_->work_out_paths(paths_);
    for (std::size_t i = 0; i < paths_.size(); ++i) courses_.go(static_cast<int>(i), paths_[i]);
    courses_.find(world, true);
    rows_.add_members();
    const PathOptions options{
        .required_gap = floor, .most_pairs = kMostNodePairs, .by_planes = true, .whole = true};
    const bool clear = [&] {
      const TimeInto time(times_.proofs_ns);
      return courses_.prove(world, [&](const Candidate&) { return options; });
    }();
    if (clear || round == options_.rounds) return;
    for (int i = 0; i < static_cast<int>(courses_.candidates.size()); ++i)
      if (!courses_.candidates[at(i)].clear) rows_.look_again(world, i);
    swept_ += sweep(sweeps(options_.path_sweeps));
  }
}

double PilePlanner::smallest_gap() const {
  double gap = std::numeric_limits<double>::infinity();
  for (const Candidate& pair : courses_.candidates)
    if (pair.contacts->gap <= contacts_.margin()) gap = std::min(gap, pair.contacts->gap);
  return gap;
}

// All impulses act at the plan's end.
Planned PilePlanner::take(const world::World& world) {
  std::vector<RigidBody> bodies = courses_.with(velocities_);
  Planned result;
  const bool any_kinematic =
      std::any_of(courses_.members.begin(), courses_.members.end(),
                  [&](const Member& m) { return world.is_moving_kinematic(m.number); });
  const bool reports = options_.report_rows || any_kinematic;
  const std::vector<RigidBody> swept = reports ? bodies : std::vector<RigidBody>{};
  rows_.give_back(world, contacts_.margin() / options_.frame, bodies);
  rows_.remember();
  if (reports) rows_.report(world, swept, bodies, options_.report_rows, result);
  for (int i = 0; i < rows(); ++i) result.pushing += gauss_seidel_->impulse(i) > 0;
  double gained = -result.kinematic_work, size = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Member& member = courses_.members[i];
    if (!member.dynamic) continue;
    const Path& path = courses_.paths[i];
    const double share = shares_[i];  // also of what it gets at the end
    const Twist without = free_velocities(courses_, i);
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

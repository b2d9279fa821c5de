#include "ch02_hull_hierarchy/study/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "ch02_hull_hierarchy/steps.hpp"

namespace fc::hulls {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A pair whose gap is larger than this share of its radii is advanced again rather than opened.
constexpr double kFarApart = 0.2;

// The share of a step in double precision that covers its own rounding.
constexpr double kShorter = 1e-12;

// Two nodes, and until when they are known to be clear.
struct Pair {
  double time = 0;  // s
  double gap = 0;   // m, certified, when they were last looked at
  int a = 0, b = 0;
};

struct Search {
  const HullModel& a;
  const ca::Motion& motion_a;
  const HullModel& b;
  const ca::Motion& motion_b;
  const TocOptions& options;
  const StudySearchOptions& study;
  StudyTimeOfContact toc{};
  bool found = false, given_up = false;
  double end = options.interval;  // s: a pair that is clear until then need not be kept. Falls to the contact
  ca::PairPose pose{motion_a, motion_b, 0};
  double pose_time = 0;

  const HullNode& node_a(const Pair& pair) const { return a.tree.nodes[pair.a]; }
  const HullNode& node_b(const Pair& pair) const { return b.tree.nodes[pair.b]; }
  double radii(const Pair& pair) const { return node_a(pair).radius + node_b(pair).radius; }
  bool leaves(const Pair& pair) const { return node_a(pair).leaf() && node_b(pair).leaf(); }
  bool far_apart(const Pair& pair) const { return pair.gap - options.target > kFarApart * radii(pair); }
  bool give_up() { return given_up = given_up || exhausted(); }
  bool exhausted() const { return toc.node_pairs + toc.leaf_pairs >= options.max_pairs; }

  // looking at a pair
  // ------------------------------------------------------------------------------------------------

  struct Look {
    double step = 0;  // s, for which the pair is clear
    ca::GjkResult gjk;
    bool reached = false;  // two leaves that are in contact
  };

  // How long `room` lasts by the bound that the options name.
  double safe_step(const Pair& pair, const ca::Convex& hull_a, const ca::Convex& hull_b, const Vec3& n,
                   double t, double room) const {
    if (study.bound == Bound::naive) {
      const Vec3 acceleration = motion_a.acceleration - motion_b.acceleration;
      const double straight = n.dot(motion_a.velocity_at(t) - motion_b.velocity_at(t)),
                   turning = motion_a.spin_rate * hull_a.reach + motion_b.spin_rate * hull_b.reach;
      const double speed =
          straight + std::max(0.0, n.dot(acceleration) * (options.interval - t)) + turning * (1 + kShorter);
      return speed > 0 ? room / speed : kInfinity;
    }
    if (study.bound == Bound::directional)
      return whole_step(motion_a, hull_a, motion_b, hull_b, n, t, options.interval, room);
    const double step = ball_step(motion_a, hull_a, node_a(pair).radius, motion_b, hull_b,
                                  node_b(pair).radius, pose, n, t, options.interval, room)
                            .time;
    if (study.bound == Bound::second_order || !leaves(pair)) return step;
    return std::max(step,
                    points_step(motion_a, hull_a, motion_b, hull_b, pose, n, t, options.interval, room).time);
  }

  Look look(const Pair& pair, double t) {
    if (t != pose_time) pose = ca::PairPose(motion_a, motion_b, pose_time = t);
    const ca::Convex hull_a = a.convex(node_a(pair)), hull_b = b.convex(node_b(pair));
    Look look;
    ca::GjkResult& g = look.gjk = ca::distance(hull_a, hull_b, pose, {options.slack / 4, 0.05, 128});
    const bool both_leaves = leaves(pair);
    if (both_leaves && g.lower <= options.target) g = leaf_distance(hull_a, hull_b, pose, options.tolerance);
    ++(both_leaves ? toc.leaf_pairs : toc.node_pairs);
    const double room = g.lower - options.target;
    if (room > 0) {
      look.step = (1 - kShorter) * safe_step(pair, hull_a, hull_b, g.normal, t, room);
      ++toc.advances;
    }
    // Leaves that overlap by rounding have no meaningful upper bound: then the lower one decides.
    const bool at_target =
        g.upper <= options.target + options.slack || g.lower <= options.target + 0.5 * options.slack;
    look.reached = both_leaves && ((at_target && t > 0) ||
                                   !(look.step > std::numeric_limits<double>::epsilon() * options.interval));
    note(pair, t, look);
    return look;
  }

  // A contact at time t; the earliest so far.
  void contact(const Pair& pair, double t, const ca::GjkResult& gjk) {
    found = true;
    end = t;
    toc.pair = {pair.a, pair.b, gjk};
  }

  std::array<Pair, 2> children(const Pair& pair) const {
    const HullNode &na = node_a(pair), &nb = node_b(pair);
    const bool open_a = nb.leaf() || (!na.leaf() && na.radius >= nb.radius);
    Pair left = pair, right = pair;
    (open_a ? left.a : left.b) = open_a ? na.left : nb.left;
    (open_a ? right.a : right.b) = open_a ? na.right : nb.right;
    return {left, right};
  }

  void note(const Pair& pair, double t, const Look& look) const {
    if (study.visits == nullptr) return;
    Fate fate = Fate::clear;
    if (look.reached)
      fate = Fate::reached;
    else if (t + look.step < end)
      fate = leaves(pair) || look.gjk.lower - options.target > kFarApart * radii(pair) ? Fate::advanced
                                                                                       : Fate::opened;
    study.visits->push_back({pair.a, pair.b, t, look.step, look.gjk.lower, radii(pair), leaves(pair), fate});
  }

  // each pair at its own time
  // ----------------------------------------------------------------------------------------

  // Looks at a pair at `time`. Returns whether it is still to be kept, with its new time.
  bool advance(Pair& pair, double time) {
    const Look now = look(pair, time);
    if (now.reached) {
      contact(pair, time, now.gjk);
      return false;
    }
    pair.time = time + now.step;
    pair.gap = now.gjk.lower;
    return pair.time < end;
  }

  // Later pairs last; of pairs of the same time, the one that can be farthest apart.
  bool later(const Pair& x, const Pair& y) const {
    if (x.time != y.time) return x.time > y.time;
    const double apart_x = std::max(0.0, x.gap) + radii(x), apart_y = std::max(0.0, y.gap) + radii(y);
    if (apart_x != apart_y) return apart_x > apart_y;
    return x.a != y.a ? x.a > y.a : x.b > y.b;
  }

  void best_first() {
    const auto order = [this](const Pair& x, const Pair& y) { return later(x, y); };
    std::priority_queue<Pair, std::vector<Pair>, decltype(order)> queue(order);
    const auto consider = [&](Pair pair, double time) {
      if (advance(pair, time)) queue.push(pair);
    };
    consider({}, 0);
    // Any contact is found at the earliest time of all waiting pairs.
    while (!queue.empty() && !found && !exhausted()) {
      const Pair top = queue.top();
      queue.pop();
      if (leaves(top) || far_apart(top))
        consider(top, top.time);
      else
        for (const Pair& child : children(top)) consider(child, top.time);
    }
    if (queue.empty() || found) return;
    given_up = true;
    end = queue.top().time;
  }

  void depth_first(Pair pair) {
    while (pair.time < end && (leaves(pair) || far_apart(pair)))
      if (give_up() || !advance(pair, pair.time)) return;
    if (pair.time >= end || give_up()) return;
    std::array<Pair, 2> below = children(pair);
    for (Pair& child : below)
      if (!advance(child, pair.time)) child.time = kInfinity;
    if (later(below[0], below[1])) std::swap(below[0], below[1]);
    for (const Pair& child : below)
      if (child.time < end) depth_first(child);
  }

  // one step for all pairs
  // -------------------------------------------------------------------------------------------

  struct Round {
    double t;                    // s
    double step;                 // s, the smallest so far
    double nearest = kInfinity;  // m, of the leaves so far
    double share = kInfinity;    // a pair with more than nearest / (1 + share) is not opened
    Pair last{};                 // the leaves with the smallest step
  };

  // C2A: which gaps are worth opening, from round to round.
  double share_of_round(double last_step) const {
    if (study.order == Order::global) return kInfinity;
    if (toc.rounds > 6 || last_step <= 0.005 * options.interval) return 0;
    return toc.rounds <= 3 ? 3 : 0.5;
  }

  void settle(Round& round, const Pair& pair, const Look& now) {
    if (leaves(pair)) {
      if (now.reached) contact(pair, round.t, now.gjk);
      round.nearest = std::min(round.nearest, now.gjk.upper);
    }
    if (now.step >= round.step) return;
    round.step = now.step;
    if (leaves(pair)) round.last = pair;
  }

  void go_through(Round& round, const Pair& pair, const Look& now) {
    if (now.step >= round.step || found || exhausted()) return;
    const bool coarse =
        round.share < kInfinity && now.gjk.lower > 0 && now.gjk.lower * (1 + round.share) >= round.nearest;
    if (leaves(pair) || (coarse && now.step > 0)) return settle(round, pair, now);
    const std::array<Pair, 2> below = children(pair);
    const Look first = look(below[0], round.t), second = look(below[1], round.t);
    const bool swap =
        second.step < first.step || (second.step == first.step && second.gjk.lower < first.gjk.lower);
    go_through(round, below[swap ? 1 : 0], swap ? second : first);
    go_through(round, below[swap ? 0 : 1], swap ? first : second);
  }

  void in_rounds() {
    double t = 0, last_step = options.interval;
    Pair last{};
    while (t < end && !give_up()) {
      ++toc.rounds;
      Round round{t, options.interval - t, kInfinity, share_of_round(last_step), last};
      // The pair that decided the last step may well decide this one: with its step there is less to look at.
      if (leaves(last)) settle(round, last, look(last, t));
      if (!found) go_through(round, {}, look({}, t));
      if (found) return;
      if (give_up()) break;
      last = round.last;
      last_step = round.step;
      t += round.step;
    }
    end = std::min(t, options.interval);
  }

  void run() {
    if (study.order == Order::best_first) best_first();
    if (study.order == Order::depth_first) {
      Pair roots;
      if (advance(roots, 0)) depth_first(roots);
    }
    if (study.order == Order::global || study.order == Order::controlled) in_rounds();
    if (given_up &&
        study.order == Order::depth_first) {  // an earlier contact may still be waiting: nothing is proved
      toc.status = TimeOfContact::Status::limit;
      toc.time = 0;
    } else {
      toc.status = found      ? TimeOfContact::Status::reached
                   : given_up ? TimeOfContact::Status::limit
                              : TimeOfContact::Status::clear;
      toc.time = end;
    }
  }
};

}  // namespace

const char* name_of(Order order) {
  static constexpr const char* names[] = {"global", "controlled", "depth first", "best first"};
  return names[static_cast<int>(order)];
}
const char* name_of(Bound bound) {
  static constexpr const char* names[] = {"naive", "directional", "second order", "points"};
  return names[static_cast<int>(bound)];
}
const char* name_of(Fate fate) {
  static constexpr const char* names[] = {"clear", "advanced", "opened", "reached"};
  return names[static_cast<int>(fate)];
}

StudyTimeOfContact study_time_of_contact(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                                         const ca::Motion& motion_b, const TocOptions& options,
                                         const StudySearchOptions& study) {
  Search search{a, motion_a, b, motion_b, options, study};
  search.run();
  return search.toc;
}

}  // namespace fc::hulls

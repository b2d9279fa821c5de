#include "ch02_hull_hierarchy/time_of_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch01_convex_advancement/rounding.hpp"
#include "ch02_hull_hierarchy/box_steps.hpp"
#include "ch02_hull_hierarchy/model_distance.hpp"
#include "ch02_hull_hierarchy/steps.hpp"
#include "ch02_hull_hierarchy/toc_by_pieces.hpp"

namespace fc::hulls {
namespace {

// A pair with more room than this share of its nodes' radii is advanced again rather than opened: it still
// has most of what the bound let it lose. Consequence: half the pairs where bodies turn fast side by side,
// the same elsewhere.
constexpr float kFarApart = 0.1f;

constexpr int kLooksAtLast = 8;  // two leaves that meet usually do so after two or three advances
constexpr double kClear = std::numeric_limits<double>::infinity();

// The share of a step in double precision that covers its own rounding.
constexpr double kShorter = 1e-12;

// The queue's top: the earliest pair; among pairs of the same time the one with the least `apart`, which
// leads straight down to leaves instead of opening every pair of that time; then the order of the trees.
struct Later {
  bool operator()(const WaitingPair& x, const WaitingPair& y) const {
    if (x.time != y.time) return x.time > y.time;
    if (x.apart != y.apart) return x.apart > y.apart;
    return x.a != y.a ? x.a > y.a : x.b > y.b;
  }
};

struct Search {
  const Model& a;
  const ca::Motion& motion_a;
  const Model& b;
  const ca::Motion& motion_b;
  const TocOptions& options;
  SearchMemory& memory;
  std::vector<WaitingPair>& queue = memory.queue;
  TimeOfContact toc{};
  StepLimits limits{};
  ca::PairPose pose{motion_a, motion_b, 0};
  double pose_time = -1;
  double horizon = kClear;  // s, a pair that is clear until here need not be kept
  PairViews views{};

  void look_from(double t) {
    pose_time = t;
    pose = ca::PairPose(motion_a, motion_b, t);
    views = views_of(pose, motion_a, a.reach, motion_b, b.reach, t);
    limits.remaining = float_above(options.interval - t);
    const double radii = a.radius + b.radius;
    limits.target = float_above(options.target + radii);
    limits.keep = t == 0 ? float_above(std::max(options.start, options.target) + radii) : limits.target;
  }

  // The time until which a pair is clear (kClear: for the whole interval) after a step (s, > 0) from t, with
  // `gap` (m) along n. Between them the gap that is proved is concave in time, so it stays above the straight
  // line from `gap` to the target: the claim of the certificate's row.
  double advanced(double t, double step, const Vec3& n, double gap, NodeId node_a, NodeId node_b) {
    ++toc.advances;
    if (t == 0) toc.start_gap = std::min(toc.start_gap, gap);
    const double remaining = ca::remaining_above(t, options.interval);
    if (memory.certificate != nullptr) {
      const BoxQuad& quad_a = a.boxes.quads[node_a >> 2];
      const BoxQuad& quad_b = b.boxes.quads[node_b >> 2];
      const double lasts = std::min(step, remaining);
      memory.certificate->certificate.push_back(
          {t, n.normalized(), gap, (gap - options.target) / lasts, lasts});
      memory.certificate->certificate_leaves.push_back(
          {quad_a.first_leaf[node_a & 3], quad_a.leaf_count[node_a & 3], quad_b.first_leaf[node_b & 3],
           quad_b.leaf_count[node_b & 3]});
    }
    return step >= remaining ? kClear : ca::sum_below(t, step);
  }

  void wait(double time, float apart, const Vec3& n, NodeId node_a, NodeId node_b) {
    if (time >= horizon) return;
    queue.push_back({time,
                     apart,
                     {static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z())},
                     node_a,
                     node_b});
    std::push_heap(queue.begin(), queue.end(), Later{});
  }

  // Four boxes of one body against a box of the other.
  struct Look {
    const OpenedView& view;
    double sign;  // of the opened body's normals, seen from A to B
    BoxSteps steps;

    Vec3 normal(int lane) const {
      return sign * (view.rotation.transpose() *
                     Vec3(steps.normal.x[lane], steps.normal.y[lane], steps.normal.z[lane]));
    }
  };
  Look look_at(const BoxQuad& quad, bool of_a, const WaitingPair& pair) const {
    const OpenedView& view = of_a ? views.a : views.b;
    const double sign = of_a ? 1 : -1;
    const Vec3 normal = Vec3(pair.normal[0], pair.normal[1], pair.normal[2]).normalized();
    const Vec3f hint = (view.rotation * (sign * normal)).cast<float>();
    return {view, sign,
            box_steps(quad, of_a ? b.boxes : a.boxes, of_a ? pair.b : pair.a, view, hint, limits)};
  }

  // Advances a pair of nodes that is far apart for its size. True: it still is, and waits again.
  bool advance_again(const WaitingPair& pair) {
    const float radii = a.boxes.radius(pair.a) + b.boxes.radius(pair.b);
    if (pair.apart - radii - limits.target <= kFarApart * radii) return false;
    const bool of_a = a.boxes.radius(pair.a) >= b.boxes.radius(pair.b);
    const NodeId node = of_a ? pair.a : pair.b;
    const Look look = look_at((of_a ? a : b).boxes.quads[node >> 2], of_a, pair);
    const int lane = node & 3;
    ++toc.node_pairs;
    if (look.steps.gap[lane] - limits.target <= kFarApart * radii) return false;
    // At the start a gap between target and tolerance is not advanced: waiting at the same time has no end.
    if (!(ca::sum_below(pair.time, look.steps.time[lane]) > pair.time)) return false;
    const Vec3 n = look.normal(lane);
    const double gap = look.steps.gap[lane] - (a.radius + b.radius);
    wait(advanced(pair.time, look.steps.time[lane], n, gap, pair.a, pair.b), look.steps.gap[lane] + radii, n,
         pair.a, pair.b);
    return true;
  }

  // Opens the larger node of a pair that is not two leaves.
  void open(const WaitingPair& pair) {
    const bool leaf_a = a.boxes.child(pair.a) < 0, leaf_b = b.boxes.child(pair.b) < 0;
    const bool open_a = leaf_b || (!leaf_a && a.boxes.radius(pair.a) >= b.boxes.radius(pair.b));
    const bool other_is_leaf = open_a ? leaf_b : leaf_a;
    const int below = open_a ? a.boxes.child(pair.a) : b.boxes.child(pair.b);
    const BoxQuad& quad = (open_a ? a : b).boxes.quads[below];
    const float other_radius = open_a ? b.boxes.radius(pair.b) : a.boxes.radius(pair.a);
    const Look look = look_at(quad, open_a, pair);
    for (int lane = 0; lane < 4 && quad.child[lane] != 0; ++lane) {
      ++toc.node_pairs;
      const NodeId child_a = open_a ? 4 * below + lane : pair.a, child_b = open_a ? pair.b : 4 * below + lane;
      const double gap = look.steps.gap[lane] - (a.radius + b.radius);
      const Vec3 n = look.normal(lane);
      const float apart = std::max(0.0f, look.steps.gap[lane]) + quad.radius[lane] + other_radius;
      double step = look.steps.time[lane], step_gap = gap;
      if (quad.child[lane] < 0 && other_is_leaf && pair.time + step < std::min(options.interval, horizon))
        step_points(pair.time, n.normalized(), child_a, child_b, step, step_gap);
      wait(step > 0 ? advanced(pair.time, step, n, step_gap, child_a, child_b) : pair.time, apart, n, child_a,
           child_b);
    }
  }

  // Tries two leaves point by point along the normal of their boxes: gives a longer step, with its gap, if
  // there is one.
  void step_points(double t, const Vec3& n, NodeId node_a, NodeId node_b, double& step, double& gap) const {
    const ca::Convex leaf_a = a.leaf(~a.boxes.child(node_a)), leaf_b = b.leaf(~b.boxes.child(node_b));
    const double points_gap = ca::support_gap(leaf_a, leaf_b, pose, n), room = points_gap - options.target;
    if (!(room > 0) || (t == 0 && points_gap <= options.start)) return;
    const double time =
        (1 - kShorter) *
        points_step(motion_a, leaf_a, motion_b, leaf_b, pose, n, t, options.interval, room).time;
    if (time <= step) return;
    step = time;
    gap = points_gap;
  }

  // Looks at two leaves at the time until which they are known to be clear. True: they have reached the
  // target.
  bool look(const WaitingPair& pair) {
    const int id_a = ~a.boxes.child(pair.a), id_b = ~b.boxes.child(pair.b);
    const ca::Convex leaf_a = a.leaf(id_a), leaf_b = b.leaf(id_b);
    ca::GjkResult g = ca::distance(leaf_a, leaf_b, pose, {options.slack / 4, 0.05, 128});
    if (g.lower <= options.target) g = leaf_distance(leaf_a, leaf_b, pose, options.tolerance);
    ++toc.leaf_pairs;
    const double room = g.lower - options.target;
    // Leaves that overlap by rounding have no meaningful upper bound: then the lower one decides.
    const bool at_target = pair.time > 0 ? g.upper <= options.target + options.slack ||
                                               g.lower <= options.target + 0.5 * options.slack
                                         : g.upper <= options.start;
    double step = 0;
    if (room > 0 && !at_target) {
      step =
          points_step(motion_a, leaf_a, motion_b, leaf_b, pose, g.normal, pair.time, options.interval, room)
              .time;
      step = std::max(
          step, whole_step(motion_a, leaf_a, motion_b, leaf_b, g.normal, pair.time, options.interval, room));
      step *= 1 - kShorter;
    }
    // No room, or a step below the rounding of the caller's times: the pair cannot be advanced any further.
    if (!(step > std::numeric_limits<double>::epsilon() * options.interval)) {
      toc.pair = {id_a, id_b, g};
      toc.time = pair.time;
      return true;
    }
    wait(advanced(pair.time, step, g.normal, g.lower, pair.a, pair.b), static_cast<float>(g.lower), g.normal,
         pair.a, pair.b);
    return false;
  }

  // The leaves that met in the query before often meet again, a little later. The time of that contact is an
  // upper bound of the first one, and a pair that is clear until then need not be kept.
  void begin_with_last() {
    WaitingPair last{0, 0, {1, 0, 0}, memory.last_a, memory.last_b};
    queue.push_back(last);
    for (int looks = 0; looks < kLooksAtLast && !queue.empty() && horizon == kClear; ++looks) {
      last = queue.front();
      queue.clear();
      if (last.time != pose_time) look_from(last.time);
      if (look(last) && last.time > 0) horizon = last.time;
    }
    queue.clear();
    if (horizon < kClear) queue.push_back(last);
    if (pose_time != 0) look_from(0);
  }

  void run() {
    queue.clear();
    look_from(0);
    if (memory.coherent && memory.last_a >= 0 && memory.certificate == nullptr) begin_with_last();
    wait(0, 0, Vec3::UnitX(), 0, 0);
    // ANCHOR: run
    while (!queue.empty()) {
      const WaitingPair top = queue.front();
      // Whether the two touch at the start is always answered.
      if (top.time > 0 && toc.node_pairs + toc.leaf_pairs >= options.max_pairs) {
        toc.status = TimeOfContact::Status::limit;
        toc.time = top.time;
        return;
      }
      std::pop_heap(queue.begin(), queue.end(), Later{});
      queue.pop_back();
      if (top.time != pose_time) look_from(top.time);
      const bool leaves = a.boxes.child(top.a) < 0 && b.boxes.child(top.b) < 0;
      if (!leaves) {
        if (!advance_again(top)) open(top);
      } else if (look(top)) {
        toc.status = TimeOfContact::Status::reached;
        memory.last_a = top.a;
        memory.last_b = top.b;
        return;
      }
    }
    // ANCHOR_END: run
    toc.status = TimeOfContact::Status::clear;
    toc.time = options.interval;
  }
};

}  // namespace

TimeOfContact time_of_contact(const Model& a, const ca::Motion& motion_a, const Model& b,
                              const ca::Motion& motion_b, const TocOptions& options, SearchMemory& memory) {
  if (memory.pieces != nullptr) return toc_by_pieces(a, motion_a, b, motion_b, options, *memory.pieces);
  Search search{a, motion_a, b, motion_b, options, memory};
  search.run();
  return search.toc;
}

TimeOfContact time_of_contact(const Model& a, const ca::Motion& motion_a, const Model& b,
                              const ca::Motion& motion_b, const TocOptions& options) {
  SearchMemory memory;
  return time_of_contact(a, motion_a, b, motion_b, options, memory);
}

}  // namespace fc::hulls

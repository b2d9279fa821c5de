#include "ch01_convex_advancement/advance.hpp"

#include <algorithm>

#include "ch01_convex_advancement/rounding.hpp"

namespace fc::ca {
namespace {

// Which feature of a core the simplex spans: its distinct points, and the smallest of their numbers.
void name_feature(const std::array<SupportPoint, 4>& points, int count, FeatureKind& kind, int& id) {
  int n = 0;
  id = points[0].index;
  for (int i = 0; i < count; ++i) {
    bool seen = false;
    for (int k = 0; k < i; ++k) seen = seen || points[k].point == points[i].point;
    n += seen ? 0 : 1;
    id = std::min(id, points[i].index);
  }
  kind = n == 1 ? FeatureKind::vertex : n == 2 ? FeatureKind::edge : FeatureKind::face;
}

FeaturePair witness(const GjkResult& g, const Vec3& origin) {
  FeaturePair pair;
  pair.point_a = origin + g.point_a;
  pair.point_b = origin + g.point_b;
  pair.normal = g.normal;
  pair.gap = g.normal.dot(g.point_b - g.point_a);
  name_feature(g.cache.a, g.cache.count, pair.kind_a, pair.id_a);
  name_feature(g.cache.b, g.cache.count, pair.kind_b, pair.id_b);
  return pair;
}

// The relative accuracy of a distance while the bodies are far apart: a plane that is nearly the best allows
// nearly the best step, and costs less.
constexpr double kFar = 0.02;

}  // namespace

void advance(const Convex& shape_a, const Motion& motion_a, const Convex& shape_b, const Motion& motion_b,
             const AdvanceOptions& options, AdvanceResult& result) {
  check_query(motion_a, motion_b, options);
  result.clear();
  result.node_pairs = 1;
  const MovingPair pair(options.bound, shape_a, motion_a, shape_b, motion_b);
  double t = 0;
  SimplexCache cache;
  Vec3 last_normal = Vec3::UnitX();
  while (true) {
    const PairPose pose(motion_a, motion_b, t);
    // Below a few rounding terms upper and lower bound cannot meet: a smaller tolerance is raised to that.
    result.tolerance = std::max(options.tolerance, 8 * rounding_term(shape_a, shape_b, pose));
    const double target =
        0.5 * result.tolerance;  // never aim at contact itself: at distance 0 there is no plane
    const GjkOptions accuracy{0.125 * result.tolerance, kFar, 128};
    GjkResult g = distance(shape_a, shape_b, pose, accuracy, options.warm_start ? &cache : nullptr);
    ++result.distance_calls;
    result.gjk_iterations += g.iterations;
    // This close, GJK's plane may be poor. Along the last advance's plane most of the target must be left.
    if (t > 0 && g.lower < target) {
      const double left = support_gap(shape_a, shape_b, pose, last_normal);
      if (left > g.lower) g.lower = left, g.normal = last_normal;
    }
    // No plane tells touching from overlapping yet: GJK found none, or stopped at a poor one.
    const bool doubtful = g.status == GjkResult::Status::overlapping ||
                          (g.upper <= result.tolerance && g.lower < -result.tolerance);
    if (t == 0 && doubtful) {
      GjkResult plane = touching_plane(shape_a, shape_b, pose, 16 * result.tolerance, g.normal);
      result.distance_calls += kTouchingPlaneCalls;
      plane.upper = g.upper;
      if (g.cache.count == 0 || plane.lower > g.lower) g = plane;
    }
    result.toc = t;
    result.gap_lower = g.lower;
    result.gap_upper = g.upper;
    if (g.upper <= result.tolerance) {
      if (t > 0)
        result.status = Status::contact;
      else
        result.status =
            g.lower < -result.tolerance ? Status::penetrating_at_start : Status::touching_at_start;
      if (result.status != Status::penetrating_at_start)
        result.features.push_back(witness(g, motion_a.position_at(t)));
      return;
    }
    if (t >= options.interval) {
      result.status = Status::separated;
      return;
    }
    if (result.iterations >= options.max_iterations || g.lower <= target) return;  // unresolved

    cache = g.cache;
    last_normal = g.normal;
    // ANCHOR: advance
    const double remaining = remaining_above(t, options.interval);
    double step = pair.safe_time(pose, g.normal, g.lower, target, t, options.interval);
    const bool clear = step >= remaining;
    step = std::min(step, remaining);
    if (options.certificate)
      result.certificate.push_back(
          {t, g.normal, g.lower, (g.lower - (1 - kStepSlack) * target) / step, step});
    const double next = clear ? options.interval : sum_below(t, step);
    if (!(next > t)) return;  // unresolved: the step is below the rounding of t
    ++result.iterations;
    t = next;
    // ANCHOR_END: advance
  }
}

AdvanceResult advance(const Convex& shape_a, const Motion& motion_a, const Convex& shape_b,
                      const Motion& motion_b, const AdvanceOptions& options) {
  AdvanceResult result;
  advance(shape_a, motion_a, shape_b, motion_b, options, result);
  return result;
}

}  // namespace fc::ca

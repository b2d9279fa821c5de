// The differences b - a of the bodies' corners are three or four points, each of which moves straight, and
// the bodies touch when the hull of these points reaches the origin. So neither GJK nor a pose is needed:
// closest_to_origin() is the distance.
#include "ch01_convex_advancement/linear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ch01_convex_advancement/rounding.hpp"
#include "ch01_convex_advancement/simplex.hpp"

namespace fc::ca {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The corners of B - A.
struct Differences {
  int count = 0;
  std::array<int, 4> of_a, of_b;     // which corners each is the difference of
  std::array<Vec3, 4> start, speed;  // m, m/s
  double rounding = 0;               // m, of n.p at any time: two sums and a product, a few eps of its size

  Differences(const LinearQuery& q, double interval) {
    const bool face = q.kind == LinearQuery::Kind::vertex_face;
    for (int a = 0; a < (face ? 1 : 2); ++a)
      for (int b = face ? 1 : 2; b < 4; ++b) {
        const Vec3 end = q.end[b] - q.end[a];
        of_a[count] = a, of_b[count] = b;
        start[count] = q.start[b] - q.start[a];
        speed[count] = interval > 0 ? Vec3((end - start[count]) / interval) : Vec3(Vec3::Zero());
        rounding = std::max(rounding, 16 * kEpsilon * (start[count].norm() + end.norm()));
        ++count;
      }
  }
};

// How long from t on the gap along n certainly stays at or above `target`, s; infinity: for ever.
double safe_time(const Differences& d, const std::array<Vec3, 4>& now, const Vec3& n, double target) {
  double time = kInfinity;
  for (int i = 0; i < d.count; ++i) {
    const double closing = 4 * kEpsilon * d.speed[i].norm() - n.dot(d.speed[i]);
    if (closing > 0) time = std::min(time, (n.dot(now[i]) - d.rounding - target) / closing);
  }
  return time;
}

FeaturePair witness(const LinearQuery& q, const Differences& d, const SimplexPoint& s, const Vec3& normal,
                    double part) {
  FeaturePair pair;
  pair.normal = normal;
  pair.gap = normal.dot(s.point);
  std::array<bool, 4> used{};
  for (int k = 0; k < s.count; ++k) {
    const int a = d.of_a[s.index[k]], b = d.of_b[s.index[k]];
    used[a] = used[b] = true;
    pair.point_a += s.weight[k] * (q.start[a] + part * (q.end[a] - q.start[a]));
    pair.point_b += s.weight[k] * (q.start[b] + part * (q.end[b] - q.start[b]));
  }
  const auto name = [&](int first, int last, FeatureKind& kind, int& id) {
    const auto n = std::count(used.begin() + first, used.begin() + last, true);
    kind = n == 1 ? FeatureKind::vertex : n == 2 ? FeatureKind::edge : FeatureKind::face;
    id = static_cast<int>(std::find(used.begin() + first, used.end(), true) - used.begin()) - first;
  };
  const int split = q.kind == LinearQuery::Kind::vertex_face ? 1 : 2;
  name(0, split, pair.kind_a, pair.id_a);
  name(split, 4, pair.kind_b, pair.id_b);
  return pair;
}

void check(const LinearQuery& q, const AdvanceOptions& options) {
  check_options(options);
  for (int i = 0; i < 4; ++i)
    if (!q.start[i].allFinite() || !q.end[i].allFinite())
      throw std::invalid_argument("advance: corner " + std::to_string(i) + " is not finite");
}

}  // namespace

void advance(const LinearQuery& query, const AdvanceOptions& options, AdvanceResult& result) {
  check(query, options);
  const Differences d(query, options.interval);
  result.clear();
  result.node_pairs = 1;
  result.tolerance = std::max(options.tolerance, 8 * d.rounding);
  const double target = 0.5 * result.tolerance;
  Vec3 normal = Vec3::UnitX();
  double t = 0;
  while (true) {
    std::array<Vec3, 4> now;
    for (int i = 0; i < d.count; ++i) now[i] = d.start[i] + t * d.speed[i];
    const SimplexPoint s = closest_to_origin(now, d.count);
    ++result.distance_calls;
    if (s.direction.norm() > 0) normal = s.direction.normalized();
    double lower = kInfinity;
    for (int i = 0; i < d.count; ++i) lower = std::min(lower, normal.dot(now[i]) - d.rounding);
    result.toc = t;
    result.gap_lower = lower;
    result.gap_upper = s.point.norm();
    if (result.gap_upper <= result.tolerance) {
      result.status = t > 0 ? Status::contact : Status::touching_at_start;
      result.features.push_back(
          witness(query, d, s, normal, options.interval > 0 ? t / options.interval : 0));
      return;
    }
    if (t >= options.interval) {
      result.status = Status::separated;
      return;
    }
    if (result.iterations >= options.max_iterations || lower <= target) return;  // unresolved
    const double remaining = remaining_above(t, options.interval);
    double step = safe_time(d, now, normal, target);
    const bool clear = step >= remaining;
    step = std::min(step, remaining);
    if (options.certificate)
      result.certificate.push_back({t, normal, lower, (lower - (1 - kStepSlack) * target) / step, step});
    const double next = clear ? options.interval : sum_below(t, step);
    if (!(next > t)) return;  // unresolved: the step is below the rounding of t
    ++result.iterations;
    t = next;
  }
}

AdvanceResult advance(const LinearQuery& query, const AdvanceOptions& options) {
  AdvanceResult result;
  advance(query, options, result);
  return result;
}

}  // namespace fc::ca

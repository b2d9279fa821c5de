#include "ch01_convex_advancement/gjk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch01_convex_advancement/rounding.hpp"
#include "ch01_convex_advancement/simplex.hpp"

namespace fc::ca {
namespace {

// GJK's simplex, in A's axes: up to four points of B - A, and where each came from.
struct Search {
  const Convex& a;
  const Convex& b;
  const Pose& b_in_a;
  std::array<Vec3, 4> points;
  std::array<SupportPoint, 4> from_a, from_b;
  int count = 0;

  // Writes the point of B - A that lies farthest against n after the simplex, without counting it.
  void support_against(const Vec3& n) {
    from_a[count] = support(a, n);
    from_b[count] = support(b, -(b_in_a.rotation.transpose() * n));
    points[count] = difference(from_a[count], from_b[count]);
  }
  Vec3 difference(const SupportPoint& pa, const SupportPoint& pb) const {
    return b_in_a * pb.point - pa.point;
  }
  bool has_next() const {
    for (int k = 0; k < count; ++k)
      if (points[k] == points[count]) return true;
    return false;
  }
  void move(int from, int to) {
    points[to] = points[from];
    from_a[to] = from_a[from];
    from_b[to] = from_b[from];
  }
  // Only the face that has the closest point stays.
  void keep(const SimplexPoint& s) {
    for (int k = 0; k < s.count; ++k)  // index[k] >= k: faces list their corners in ascending order
      if (s.index[k] != k) move(s.index[k], k);
    count = s.count;
  }
  void start(const SimplexCache* cache) {
    if (cache != nullptr && cache->count > 0) {
      for (count = 0; count < cache->count && count < 3; ++count) {
        from_a[count] = cache->a[count];
        from_b[count] = cache->b[count];
        points[count] = difference(from_a[count], from_b[count]);
      }
      return;
    }
    const Vec3 toward = b_in_a * b.center - a.center;
    support_against(toward.squaredNorm() > 0 ? toward : Vec3(Vec3::UnitX()));
    count = 1;
  }
};

}  // namespace

double rounding_term(const Convex& a, const Convex& b, const PairPose& pose) {
  return 32 * kEpsilon * (a.reach + b.reach + a.radius + b.radius + pose.b_in_a.position.norm()) +
         8 * kEpsilon * (pose.travelled + pose.turned_a * a.reach + pose.turned_b * b.reach);
}

double support_gap(const Convex& a, const Convex& b, const PairPose& pose, const Vec3& normal) {
  const Vec3 n = pose.rotation_a.transpose() * normal;
  const Vec3 point_a = support(a, n).point;
  const Vec3 point_b = support(b, -(pose.b_in_a.rotation.transpose() * n)).point;
  return n.dot(pose.b_in_a * point_b - point_a) - a.radius - b.radius - rounding_term(a, b, pose);
}

GjkResult distance(const Convex& a, const Convex& b, const PairPose& pose, const GjkOptions& options,
                   const SimplexCache* cache) {
  Search search{a, b, pose.b_in_a, {}, {}, {}, 0};
  search.start(cache);
  const double rounding = rounding_term(a, b, pose);
  const double radii = a.radius + b.radius;

  GjkResult result;
  double best_gap = -std::numeric_limits<double>::infinity();  // of the cores, before rounding and radii
  double best_length = std::numeric_limits<double>::infinity();
  Vec3 normal_in_a = Vec3::UnitX();
  SimplexPoint closest;
  closest.count = 0;
  for (result.iterations = 1; result.iterations <= options.max_iterations; ++result.iterations) {
    const SimplexPoint s = closest_to_origin(search.points, search.count);
    const double size = s.direction.norm();
    const Vec3 direction = size > 0 ? Vec3(s.direction / size) : s.direction;
    const double length = direction.dot(s.point);
    // The cores overlap, or are closer than the rounding of their coordinates: there is no certain direction.
    if (s.count == 4 || !(length > rounding)) {
      result.status = GjkResult::Status::overlapping;
      break;
    }
    const bool stalled = length >= best_length;  // down to rounding: the simplex before was as good
    search.keep(s);
    if (!stalled) {
      best_length = length;
      closest = s;
      std::copy_n(search.from_a.begin(), s.count, result.cache.a.begin());
      std::copy_n(search.from_b.begin(), s.count, result.cache.b.begin());
      result.cache.count = s.count;
    }

    search.support_against(direction);
    const double gap = direction.dot(search.points[search.count]);
    if (gap > best_gap) {
      best_gap = gap;
      normal_in_a = direction;
    }
    const double slack = std::max(options.absolute, options.relative * (best_length - radii));
    if (best_length - best_gap <= slack || stalled || search.has_next()) {
      result.status = GjkResult::Status::separated;
      break;
    }
    ++search.count;
  }

  result.lower = best_gap - radii - rounding;
  result.normal = pose.rotation_a * normal_in_a;
  if (result.status == GjkResult::Status::overlapping) {
    result.upper = 0;
    result.lower = std::min(0.0, result.lower);
    result.cache.count = 0;
    return result;
  }
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();
  for (int k = 0; k < closest.count; ++k) {
    point_a += closest.weight[k] * result.cache.a[k].point;
    point_b += closest.weight[k] * (pose.b_in_a * result.cache.b[k].point);
  }
  const Vec3 toward_b = closest.point / best_length;
  result.upper = std::max(0.0, best_length - radii);
  result.point_a = pose.rotation_a * (point_a + a.radius * toward_b);
  result.point_b = pose.rotation_a * (point_b - b.radius * toward_b);
  if (result.status == GjkResult::Status::separated && result.lower <= 0) {
    // The cores are apart, but the rounded shapes, or the rounding term, leave no certified gap.
    if (best_length <= radii + rounding) result.status = GjkResult::Status::overlapping;
  }
  return result;
}

GjkResult touching_plane(const Convex& a, const Convex& b, const PairPose& pose, double push,
                         const Vec3& hint) {
  GjkResult best;
  best.lower = -std::numeric_limits<double>::infinity();
  const GjkOptions exact{0, 1e-12, 128};
  for (int k = 0; k < kTouchingPlaneCalls; ++k) {
    const Vec3 direction = k == 7   ? hint
                           : k == 6 ? pose.offset_world
                                    : Vec3(Vec3::Unit(k / 2) * (k % 2 == 0 ? 1 : -1));
    if (direction.squaredNorm() == 0) continue;
    const Vec3 aside = push * direction.normalized();
    PairPose apart = pose;
    apart.offset_world += aside;
    apart.b_in_a.position = pose.rotation_a.transpose() * apart.offset_world;
    const GjkResult moved = distance(a, b, apart, exact);
    const double lower = support_gap(a, b, pose, moved.normal);  // any plane certifies, converged or not
    if (lower > best.lower) {
      best = moved;
      best.lower = lower;
      best.point_b -= aside;  // back with B
    }
  }
  best.status = GjkResult::Status::overlapping;
  best.upper = 0;
  return best;
}

}  // namespace fc::ca

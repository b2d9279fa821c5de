#include "ch01_convex_advancement/gjk.hpp"

#include <cmath>
#include <limits>

#include "ch01_convex_advancement/simplex.hpp"

namespace fc::ca {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// A point of the difference B - A, in A's axes, and where it came from.
struct Vertex {
  Vec3 difference;
  int a, b;
};

// The closest point's direction, with the digits that the point itself lost by cancellation: exactly across
// the edge or the face that spans it. A plane that leans by a hair against a long face would certify much
// less.
Vec3 direction_of(const SimplexPoint& s, const std::array<Vec3, 4>& points) {
  if (s.count == 2) {
    const Vec3 e = points[s.index[1]] - points[s.index[0]];
    return s.point - e * (e.dot(s.point) / e.squaredNorm());
  }
  if (s.count == 3) {
    const Vec3& p = points[s.index[0]];
    const Vec3 n = (points[s.index[1]] - p).cross(points[s.index[2]] - p);
    return n.dot(s.point) < 0 ? Vec3(-n) : n;
  }
  return s.point;
}

struct Search {
  const Convex& a;
  const Convex& b;
  const Pose& b_in_a;
  std::array<Vec3, 4> points;
  std::array<int, 4> index_a{}, index_b{};
  int count = 0;

  Vec3 difference(int i, int j) const { return b_in_a * b.points[j] - a.points[i]; }

  // The point of B - A that lies farthest against n (A's axes).
  Vertex support_against(const Vec3& n) const {
    const int i = support(a.points, n);
    const int j = support(b.points, -(b_in_a.rotation.transpose() * n));
    return {difference(i, j), i, j};
  }
  void add(const Vertex& v) {
    points[count] = v.difference;
    index_a[count] = v.a;
    index_b[count] = v.b;
    ++count;
  }
  bool has(const Vertex& v) const {
    for (int k = 0; k < count; ++k)
      if (index_a[k] == v.a && index_b[k] == v.b) return true;
    return false;
  }
  void keep(SimplexPoint& s) {           // only the face that has the closest point
    for (int k = 0; k < s.count; ++k) {  // index[k] >= k: faces list their corners in ascending order
      const int from = s.index[k];
      points[k] = points[from];
      index_a[k] = index_a[from];
      index_b[k] = index_b[from];
      s.index[k] = k;
    }
    count = s.count;
  }
};

void sort_face(SimplexPoint& s) {  // ascending corners, so that keep() can move them down in place
  for (int i = 1; i < s.count; ++i)
    for (int k = i; k > 0 && s.index[k - 1] > s.index[k]; --k) {
      std::swap(s.index[k - 1], s.index[k]);
      std::swap(s.weight[k - 1], s.weight[k]);
    }
}

void start(Search& search, const SimplexCache* cache) {
  if (cache != nullptr && cache->count > 0) {
    for (int k = 0; k < cache->count && k < 3; ++k)
      search.add({search.difference(cache->a[k], cache->b[k]), cache->a[k], cache->b[k]});
    return;
  }
  const Vec3 toward = search.b_in_a * search.b.center - search.a.center;
  search.add(search.support_against(toward.squaredNorm() > 0 ? toward : Vec3(Vec3::UnitX())));
}

}  // namespace

double reach_of(std::span<const Vec3> points) {
  double reach2 = 0;
  for (const Vec3& p : points) reach2 = std::max(reach2, p.squaredNorm());
  return std::sqrt(reach2) * (1 + 4 * kEpsilon);
}

int support(std::span<const Vec3> points, const Vec3& direction) {
  int best = 0;
  double most = points[0].dot(direction);
  for (int i = 1; i < static_cast<int>(points.size()); ++i) {
    const double value = points[i].dot(direction);
    if (value > most) {
      most = value;
      best = i;
    }
  }
  return best;
}

double rounding_term(const Convex& a, const Convex& b, const PairPose& pose) {
  return 32 * kEpsilon * (a.reach + b.reach + a.radius + b.radius + pose.b_in_a.position.norm()) +
         8 * kEpsilon * (pose.travelled + pose.turned_a * a.reach + pose.turned_b * b.reach);
}

double support_gap(const Convex& a, const Convex& b, const PairPose& pose, const Vec3& normal) {
  const Vec3 n = pose.rotation_a.transpose() * normal;
  const int i = support(a.points, n);
  const int j = support(b.points, -(pose.b_in_a.rotation.transpose() * n));
  return n.dot(pose.b_in_a * b.points[j] - a.points[i]) - a.radius - b.radius - rounding_term(a, b, pose);
}

GjkResult distance(const Convex& a, const Convex& b, const PairPose& pose, const GjkOptions& options,
                   const SimplexCache* cache) {
  Search search{a, b, pose.b_in_a, {}, {}, {}, 0};
  start(search, cache);
  const double rounding = rounding_term(a, b, pose);
  const double radii = a.radius + b.radius;

  GjkResult result;
  double best_gap = -std::numeric_limits<double>::infinity();  // of the cores, before rounding and radii
  double best_length = std::numeric_limits<double>::infinity();
  Vec3 normal_in_a = Vec3::UnitX();
  SimplexPoint closest;
  for (result.iterations = 1; result.iterations <= options.max_iterations; ++result.iterations) {
    SimplexPoint s = closest_to_origin(search.points, search.count);
    sort_face(s);
    const double length = s.point.norm();
    // The cores overlap, or are closer than the rounding of their coordinates: no direction to speak of.
    if (s.count == 4 || length <= rounding) {
      result.status = GjkResult::Status::overlapping;
      break;
    }
    const bool stalled = length >= best_length;  // rounding has the last word: the former simplex was as good
    Vec3 direction = direction_of(s, search.points);
    const double size = direction.norm();
    direction = size > 0 ? Vec3(direction / size) : Vec3(s.point / length);
    search.keep(s);
    if (length < best_length) {
      best_length = length;
      closest = s;
      for (int k = 0; k < s.count; ++k) {
        result.cache.a[k] = search.index_a[k];
        result.cache.b[k] = search.index_b[k];
      }
      result.cache.count = s.count;
    }

    const Vertex next = search.support_against(direction);
    const double gap = direction.dot(next.difference);
    if (gap > best_gap) {
      best_gap = gap;
      normal_in_a = direction;
    }
    const double slack = std::max(options.absolute, options.relative * (best_length - radii));
    if (best_length - best_gap <= slack || stalled || search.has(next)) {
      result.status = GjkResult::Status::separated;
      break;
    }
    search.add(next);
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
    point_a += closest.weight[k] * a.points[result.cache.a[k]];
    point_b += closest.weight[k] * (pose.b_in_a * b.points[result.cache.b[k]]);
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

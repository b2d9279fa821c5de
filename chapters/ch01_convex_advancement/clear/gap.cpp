// 1.7, in its clear form: the method of Gilbert, Johnson and Keerthi.
#include <cmath>
#include <limits>

#include "ch01_convex_advancement/clear/pieces.hpp"
#include "ch01_convex_advancement/gjk.hpp"

namespace fc::ca::clear {
namespace {

// A corner of the simplex: a point of B - A in world axes, and the two points that it is the difference of.
struct Corner {
  Vec3 point;
  SupportPoint from_a, from_b;  // body axes
};

// The point of B - A farthest against n.
Corner support_against(const Vec3& n, const Convex& a, const Convex& b, const PairPose& pose) {
  Corner s;
  s.from_a = support(a, pose.rotation_a.transpose() * n);
  s.from_b = support(b, -(pose.rotation_b.transpose() * n));
  s.point = pose.offset_world + pose.rotation_b * s.from_b.point - pose.rotation_a * s.from_a.point;
  return s;
}

// x/|x|, with the digits that a short x has lost: exactly across the edge or the triangle that x lies on.
Vec3 direction_of(const Vec3& x, const std::vector<Corner>& simplex) {
  Vec3 n = x.normalized();
  if (simplex.size() == 2) {
    const Vec3 edge = (simplex[1].point - simplex[0].point).normalized();
    n = (n - n.dot(edge) * edge).normalized();
  }
  if (simplex.size() == 3) {
    const Vec3 across =
        (simplex[1].point - simplex[0].point).cross(simplex[2].point - simplex[0].point).normalized();
    n = across.dot(x) < 0 ? Vec3(-across) : across;
  }
  return n;
}

}  // namespace

// ANCHOR: gap
Gap gap(const Convex& a, const Convex& b, const PairPose& pose, double accuracy,
        ClosestPointFunction* closest_point) {
  constexpr int kMostIterations = 128;
  const double rounding = rounding_term(a, b, pose), radii = a.radius + b.radius;
  Gap best;
  best.lower = -std::numeric_limits<double>::infinity();
  double shortest = std::numeric_limits<double>::infinity();  // the smallest |x| so far
  const Vec3 toward = pose.offset_world.norm() > 0 ? pose.offset_world : Vec3(Vec3::UnitX());
  std::vector<Corner> simplex{support_against(toward, a, b, pose)};
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    // The point x of the simplex closest to the origin. Corners without weight are dropped.
    std::vector<Vec3> points;
    for (const Corner& c : simplex) points.push_back(c.point);
    const ClosestPoint closest = closest_point(points);
    std::vector<Corner> kept;
    Vec3 point_a = Vec3::Zero(), point_b = pose.offset_world;
    for (std::size_t i = 0; i < simplex.size(); ++i) {
      if (!(closest.weight[i] > 0)) continue;
      kept.push_back(simplex[i]);
      point_a += closest.weight[i] * (pose.rotation_a * simplex[i].from_a.point);
      point_b += closest.weight[i] * (pose.rotation_b * simplex[i].from_b.point);
    }
    simplex = kept;
    const double length = closest.point.norm();
    if (simplex.size() == 4 || !(length > rounding)) {  // the origin is in B - A: no direction is left
      best.lower = std::min(0.0, best.lower);
      best.upper = 0;
      best.corners = 0;
      return best;
    }
    if (!(length < shortest)) break;  // only rounding is left to gain
    shortest = length;

    // |x| is an upper bound: two points are that far apart. The rounding radii are subtracted.
    const Vec3 n = direction_of(closest.point, simplex);
    best.upper = std::max(0.0, length - radii);
    best.point_a = point_a + a.radius * n;
    best.point_b = point_b - b.radius * n;
    best.corners = static_cast<int>(simplex.size());
    for (std::size_t i = 0; i < simplex.size(); ++i) {
      best.from_a[i] = simplex[i].from_a;
      best.from_b[i] = simplex[i].from_b;
    }

    // n.s is a lower bound: the support gap along n. The best one so far counts.
    const Corner s = support_against(n, a, b, pose);
    const double lower = n.dot(s.point) - radii - rounding;
    if (lower > best.lower) {
      best.lower = lower;
      best.normal = n;
    }
    if (best.upper - best.lower <= accuracy) break;
    for (const Corner& c : simplex)
      if (c.point == s.point) return best;  // nothing lies farther against n than the simplex does
    simplex.push_back(s);
  }
  return best;
}
// ANCHOR_END: gap

}  // namespace fc::ca::clear

#include "ch01_convex_advancement/clear/answer.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "ch01_convex_advancement/gjk.hpp"

namespace fc::ca::clear {
namespace {

// Which feature the simplex spans: its distinct points, and the smallest of their numbers.
void name_feature(const std::array<SupportPoint, 4>& corners, int count, FeatureKind& kind, int& id) {
  std::set<int> distinct;
  for (int i = 0; i < count; ++i) distinct.insert(corners[i].index);
  id = *distinct.begin();
  kind = distinct.size() == 1   ? FeatureKind::vertex
         : distinct.size() == 2 ? FeatureKind::edge
                                : FeatureKind::face;
}

}  // namespace

void check_clear_query(const Motion& motion_a, const Motion& motion_b, const AdvanceOptions& options) {
  check_query(motion_a, motion_b, options);
  if (!motion_a.steady() || !motion_b.steady())
    throw std::invalid_argument(
        "the clear advancement knows motions with constant spin and constant acceleration alone");
}

Mover mover(const Convex& shape, const Motion& motion, double t) {
  return {motion.velocity_at(t), motion.acceleration_at(t), motion.spin_at(t), shape.reach};
}

void report(AdvanceResult& result, double t, const Gap& gap, double tolerance) {
  result.node_pairs = 1;
  ++result.distance_calls;
  result.tolerance = tolerance;
  result.toc = t;
  result.gap_lower = gap.lower;
  result.gap_upper = gap.upper;
}

Status status_at_start(const Convex& a, const Convex& b, const PairPose& pose, const Gap& gap,
                       double tolerance, AdvanceResult& result) {
  double lower = gap.lower;
  if (gap.corners == 0 || lower < -tolerance)
    lower = std::max(lower, touching_plane(a, b, pose, 16 * tolerance, gap.normal).lower);
  result.gap_lower = std::min(lower, gap.upper);
  return lower < -tolerance ? Status::penetrating_at_start : Status::touching_at_start;
}

FeaturePair witness(const Gap& gap, const Vec3& centre_a) {
  FeaturePair pair;
  pair.point_a = centre_a + gap.point_a;
  pair.point_b = centre_a + gap.point_b;
  pair.normal = gap.normal;
  pair.gap = gap.normal.dot(gap.point_b - gap.point_a);
  name_feature(gap.from_a, gap.corners, pair.kind_a, pair.id_a);
  name_feature(gap.from_b, gap.corners, pair.kind_b, pair.id_b);
  return pair;
}

}  // namespace fc::ca::clear

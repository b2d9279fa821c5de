// Distance of two models at one pose.
#pragma once

#include <limits>
#include <vector>

#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// Two leaves, with GJK's result for them.
struct LeafPair {
  int a = -1, b = -1;  // leaves
  ca::GjkResult
      gjk;  // bounds, plane and witness points (from A's centre of mass); lower < 0: overlap along the plane
};

struct ModelDistance {
  // m, certified; negative: a lower bound of the signed distance of the deepest pair of leaves.
  double lower = 0;
  double upper = 0;                             // m, of the nearest witness points; 0 if leaves touch
  LeafPair nearest;                             // not set (a = -1) if nothing lies within the cutoff
  std::int64_t node_pairs = 0, leaf_pairs = 0;  // that were looked at
};

// Distance of the surfaces, best first: the pair of nodes with the smallest lower bound is opened next, and a
// pair that cannot come nearer than the nearest witness points is never opened. `tolerance` (m) as for
// leaf_distance. Above `cutoff` (m) only lower >= cutoff is guaranteed, and above the tolerance only lower >=
// share * upper (1: as exact as possible): far apart, a rough answer takes a fraction of the time. A solid
// inside another is not noticed here; inside.hpp does that.
ModelDistance model_distance(const Model& a, const Model& b, const ca::PairPose& pose, double tolerance,
                             double cutoff = std::numeric_limits<double>::infinity(), double share = 1);

// All pairs of leaves whose certified gap is at most `threshold` (m), in the order of the trees.
std::vector<LeafPair> leaf_pairs_within(const Model& a, const Model& b, const ca::PairPose& pose,
                                        double threshold, double tolerance);

// Distance of two leaves; where they touch or overlap, along the best plane that can be found. Upper less
// lower bound is at most tolerance/16 (m), or 1e-6 of upper, where they are apart; overlaps of up to a few
// tolerances are measured.
ca::GjkResult leaf_distance(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& pose,
                            double tolerance);

}  // namespace fc::hulls

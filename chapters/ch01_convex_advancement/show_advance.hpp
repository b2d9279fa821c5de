// Conservative advancement, drawn: one query's certificate as steps that a student goes through.
#pragma once

#include "ch01_convex_advancement/query.hpp"
#include "common/algorithm.hpp"

namespace fc::ca {

// Two convex bodies and their motions. Times of the motions count from `from`.
struct ShownPair {
  int number_a = 0, number_b = 0;  // of the bodies in the scene
  Convex a, b;
  Motion motion_a, motion_b;
  double from = 0, to = 0;  // s in the frame: the query's interval
  double tolerance = 1e-6;  // m
};

// The query, with its certificate.
AdvanceResult certified_advance(const ShownPair& pair);

// Steps for a certificate: the slab at each advance, the bound, and the staircase under the curve of the true gap. frame_start:
// s, added to the times in the texts and charts.
std::vector<algorithm::Step> show_advance(const ShownPair& pair, const AdvanceResult& result,
                                          double frame_start);

// A body where its motion takes it after t seconds.
algorithm::BodyPose pose_at(int number, const Motion& motion, double t);

}  // namespace fc::ca

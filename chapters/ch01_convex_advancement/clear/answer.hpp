// The surroundings of the loop of conservative advancement: its input and its answer.
#pragma once

#include "ch01_convex_advancement/clear/pieces.hpp"

namespace fc::ca::clear {

// Throws std::invalid_argument for what check_query() refuses, and for a motion with a varying spin or drag.
void check_clear_query(const Motion& motion_a, const Motion& motion_b, const AdvanceOptions& options);

// A body at time t (s), in the form that the speed bound takes.
Mover mover(const Convex& shape, const Motion& motion, double t);

// Records what is known at time t (s): the bounds of the gap, and the tolerance (m) that holds there.
void report(AdvanceResult& result, double t, const Gap& gap, double tolerance);

// For bodies within the tolerance at t = 0: whether they touch, or overlap by more than the tolerance. If GJK's plane
// does not tell, touching_plane() looks for a better one, whose bound goes into result.gap_lower.
Status status_at_start(const Convex& a, const Convex& b, const PairPose& pose, const Gap& gap,
                       double tolerance, AdvanceResult& result);

// The pair of features that the witness points lie on. centre_a: A's centre of mass, m, world.
FeaturePair witness(const Gap& gap, const Vec3& centre_a);

}  // namespace fc::ca::clear

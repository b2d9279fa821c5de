// The paper's search: the same as first_reach, with convex pieces for leaves and convex hulls for volumes.
#pragma once

#include "ch02_hull_hierarchy/advance.hpp"
#include "ch02_hull_hierarchy/hull_model.hpp"

namespace fc::hulls {

// Pairs of nodes wait in a queue, each with a time until which it is proved to keep the target gap. The
// earliest is taken: its hulls' certified gap and a bound on their closing speed prove it clear for longer,
// and it goes back into the queue, or, where the gap is small against the nodes, its children go. The leaves
// of Reach::pair are pieces. Zhang, Lee, Kim (2006), section 5 (there one global step; here each pair has its
// own time).
Reach reach_by_hulls(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                     const ca::Motion& motion_b, const ReachOptions& options);

}  // namespace fc::hulls

// Where chapters 1 and 2 enter a step: the next contact of a pair, and all that touches at one instant.
#pragma once

#include <optional>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

// Finds when the pair next reaches its target gap, between `now` and dt (s in the frame), and stores this in the pair.
//
// The gap rule: a pair stops at half the tolerance. A pair that is within the tolerance already (it has just collided)
// may spend half of the gap that is left, so that it can part, or slide, and can never reach zero. A pair whose gap is
// below a hundredth of the tolerance has nothing left to spend: it is clear if it provably keeps half of its gap (below
// 64 rounding terms: all of it, except for those), else it is stalled. `gap` (m) is the pair's certified gap now, if it
// is known to be within the tolerance.
void find_next_contact(const World& world, Pair& pair, double now, double dt, std::optional<double> gap,
                       StepReport& report);

// The features of a pair at a pose that are within a distance (m) of each other; see hulls::contact_features, also for
// `gap`. For two convex bodies only those whose normal separates them, up to that distance: farther apart than the
// tolerance, features near an edge that both share can be near each other in other directions, too.
std::vector<ca::FeaturePair> near_features(const World& world, int a, int b, const ca::PairPose& pose,
                                           const Vec3& origin_a, double within, double* gap);

struct PairGap {
  int a = 0, b = 0;  // bodies
  double gap = 0;    // m, certified
};

// Bodies that are connected by touching pairs, and the contacts between them.
struct Island {
  std::vector<int> bodies;  // that can move, ascending
  std::vector<lcp::Contact> contacts;
  std::vector<PairGap> gaps;  // of the pairs that touch
};

// Everything that touches (gap within the tolerance) at time `now` and is connected to the two given bodies through
// bodies that can move.
Island touching_island(const World& world, int a, int b, double now, StepReport& report);

}  // namespace fc::world

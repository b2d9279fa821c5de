// Contact features of two convex leaves of which at least one is a cylinder or a cone.
#pragma once

#include <vector>

#include "ch02_hull_hierarchy/model_distance.hpp"
#include "ch02_hull_hierarchy/outline.hpp"

namespace fc::hulls {

// All contacts lie along one plane: the one with the largest gap between the two, or a face's or a cap's own where
// that is as good. Both sides' outlines (outline.hpp; of a polyhedron all that lies within twice the tolerance of the
// plane) are projected onto it, and the corners of what they share are the contacts: two ends of its line for a
// cylinder that lies on a box, eight points of its rim for one that stands on it. Each gap is that of the two
// surfaces there, along the plane's normal; those above `tolerance` (m) are left out. In A's axes, from A's centre of
// mass. a, b: convex, or meshes, of which pair.a and pair.b are the leaves.
std::vector<ca::FeaturePair> curved_features(const Model& a, const Model& b, const ca::PairPose& pose,
                                             const LeafPair& pair, double tolerance);

}  // namespace fc::hulls

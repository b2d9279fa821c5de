// Whether a point lies inside a closed mesh.
#pragma once

#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// How often the closed surface winds around the point (m, shape axes): 1 inside, 0 outside and in a cavity,
// up to rounding. The sum of the solid angles of all triangles over 4 pi; each angle by van Oosterom and
// Strackee's formula (1983).
double winding_number(const FeatureMesh& mesh, const Vec3& point);

// Whether a part of one model lies inside the other by more than `tolerance` (m), though their surfaces may
// be apart. One point of each component of either model is tested, two tolerances below the component's own
// surface, so that a part that only rests on the other, flush or in a corner, counts as outside. The test
// casts a ray through the hierarchy, and takes a microsecond or two for 70,000 triangles.
bool one_inside_other(const Model& a, const Model& b, const ca::PairPose& pose, double tolerance);

}  // namespace fc::hulls

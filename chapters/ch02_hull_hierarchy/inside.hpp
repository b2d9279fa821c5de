// Whether a point lies inside a closed mesh.
#pragma once

#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// How often the closed surface winds around the point (m, shape axes): 1 inside, 0 outside and in a cavity,
// up to rounding. The sum of the solid angles of all triangles over 4 pi; each angle by van Oosterom and
// Strackee's formula (1983).
double winding_number(const FeatureMesh& mesh, const Vec3& point);

// Whether a part of one model lies inside the other though their surfaces are apart: one vertex of every
// component of either is tested against the other. Costs a pass over all triangles for each: meant for the
// start of a simulation.
bool one_inside_other(const Model& a, const Model& b, const ca::PairPose& pose);

}  // namespace fc::hulls

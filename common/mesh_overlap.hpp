// Closed parts of one mesh that share volume.
#pragma once

#include <vector>

#include "common/mesh.hpp"

namespace fc {

// How many components of a solid share volume with another one. A point counts as matter as often as the
// surface winds around it: two parts overlap where that is more than once. A cavity subtracts one, so a ball
// in a hollow shell overlaps nothing.
//
// `component`: the component of each triangle, 0 to components - 1. Outward components must face outward, and
// cavities inward, as prepare_mesh leaves them.
//
// Guarantee: each one counted shares volume with another. Limit: overlaps thinner than about 1e-5 of the
// mesh's extent (of its distance from the origin, if larger) may be missed; parts that were drawn flush, and
// rounded to floats, are not counted.
int count_overlapping(const TriangleMesh& mesh, const std::vector<int>& component, int components);

}  // namespace fc

// Closed parts of one mesh that share volume.
#pragma once

#include <vector>

#include "common/mesh.hpp"

namespace fc {

// How many components of a solid share volume with another one. A point is counted as matter as often as the
// surface winds around it, so that two parts overlap where this is more than once; a cavity takes one away, so
// that a ball in a hollow shell overlaps nothing.
//
// `component`: of each triangle, from 0 to below `components`. Outward components must face outward, and
// cavities inward, as prepare_mesh leaves them.
//
// Guarantee: each one counted shares volume with another. Limit: overlaps thinner than some 1e-5 of the mesh's
// extent (that of its distance from the origin, if larger) may be missed; parts that were drawn flush, and
// rounded to floats, are not counted.
int count_overlapping(const TriangleMesh& mesh, const std::vector<int>& component, int components);

}  // namespace fc

// What of a compound's parts is on the surface of their union.
#pragma once

#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// Whether a compound shows this outward normal (unit) at a point of the surface of one of its parts: no other
// part that the point is on, or in, leads farther along the normal. Else the point is the edge of a part
// where another one goes on: no body outside can feel it. Point and normal in shape axes.
bool shows(const Model& compound, int part, const Vec3& point, const Vec3& outward);

}  // namespace fc::hulls

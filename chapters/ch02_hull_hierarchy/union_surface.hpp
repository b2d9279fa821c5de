// Which points of a compound's parts are on the surface of the union.
#pragma once

#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// Whether a compound has this outward normal (unit) at a point of the surface of one of its parts. It has, if no other
// part that contains the point reaches farther along the normal. Otherwise that other part covers the point, and no
// body outside can touch it. Point and normal in shape axes.
bool shows(const Model& compound, int part, const Vec3& point, const Vec3& outward);

}  // namespace fc::hulls

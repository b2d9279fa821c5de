// Exercise 1.6: the point of a simplex that is closest to the origin.
#pragma once

#include "ch01_convex_advancement/clear/pieces.hpp"

namespace fc::mine {

using ca::clear::ClosestPoint;

// simplex: 1 to 4 corners, m, of any size: nanometres are no flatter than metres. They may be flat (three on a line, four in
// a plane), and some may be equal.
// The point of their convex hull that is closest to the origin, and the weight of each corner in it:
//   point = sum of weight[i] * simplex[i],  every weight >= 0, their sum 1 (to 1e-12).
// A weight of exactly 0 means that the corner is not needed. As few corners as possible have a weight: one if the point is a
// corner, two on an edge, three on a triangle; four mean that the origin is inside. weight[i] is 0 where there is no corner i.
// The point is exact to 1e-12 of the largest |corner|, and to 1e-10 where the simplex is nearly flat.
ClosestPoint closest_point(std::span<const Vec3> simplex);

}  // namespace fc::mine

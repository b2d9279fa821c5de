// Exercise 1.7: the gap of two convex shapes, by the method of Gilbert, Johnson and Keerthi (GJK).
#pragma once

#include "ch01_convex_advancement/clear/pieces.hpp"
#include "ch01_convex_advancement/gjk.hpp"  // rounding_term

namespace fc::mine {

using ca::clear::ClosestPointFunction;
using ca::clear::Gap;

// The distance of A and B at a pose, enclosed by two bounds. All points below are in world axes, from A's centre of mass: a
// point p of A is at rotation_a p, a point q of B at offset_world + rotation_b q. ca::support(shape, direction) takes a
// direction in the shape's own axes.
//   closest_point: that of 1.6; call it, and nothing else, for a simplex of B - A.
//   accuracy: m; stop when upper - lower is at most this. Stop, too, when the farthest point is already a corner, or |x| no
//     longer falls; and after 128 iterations, whatever the bounds are then.
//
// Returns
//   upper    |x| less both radii, at least 0: the distance of point_a and point_b
//   lower    the largest support gap found, less both radii and rounding_term(a, b, pose): never above the true
//            distance
//   normal   the unit vector from A to B along which `lower` was found
//            Near contact, too: of boxes of 1 m that are 1 nm apart `lower` must be exact to 1e-11 m. There x/|x| has lost
//            digits; the edge or the triangle that x lies on has them.
//   point_a, point_b   on the shapes, where they are `upper` apart: the weights of x, put on the points of A and of B that made
//            the corners; then moved by the radii, along x and against it. (Where the balls overlap, `upper` is 0, and the
//            points lie past each other.)
//   corners, from_a, from_b   the simplex that x is a point of: how many corners, and which point of each body made them
// If x comes to within rounding_term() of the origin, or all four corners are needed, the cores overlap: upper = 0, corners = 0
// and lower <= 0.
Gap gap(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& pose, double accuracy,
        ClosestPointFunction* closest_point);

}  // namespace fc::mine

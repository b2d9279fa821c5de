#include "ex08_speed_bound.hpp"

#include "common/todo.hpp"

namespace fc::mine {

double speed_bound(const Vec3& n, const Mover& a, const Mover& b, double duration) {
  FC_TODO("1.8");
}

}  // namespace fc::mine

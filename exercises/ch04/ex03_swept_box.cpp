#include "ex03_swept_box.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

world::Bounds swept_box(const Vec3& half, const RigidBody& start, const Vec3& acceleration, double dt) {
  FC_TODO("4.3");
}

}  // namespace fc::exercises

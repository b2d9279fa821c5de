#include "ex01_capsule.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

double closing_speed(const Capsule& a, const Capsule& b, const Vec3& n) {
  FC_TODO("2.1");
}

double safe_step(const Capsule& a, const Capsule& b, const Vec3& n, double room) {
  FC_TODO("2.1");
}

}  // namespace fc::exercises

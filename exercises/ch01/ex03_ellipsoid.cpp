#include "ex03_ellipsoid.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Vec3 ellipsoid_support(const Vec3& half_axes, const Vec3& direction) {
  FC_TODO("1.3");
}

double ellipsoid_reach(const Vec3& half_axes, const Vec3& axis) {
  FC_TODO("1.3");
}

double ellipsoid_speed_bound(const Vec3& half_axes, const Vec3& n, const Vec3& spin) {
  FC_TODO("1.3");
}

}  // namespace fc::exercises

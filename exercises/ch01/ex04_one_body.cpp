#include "ex04_one_body.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Vec3 support(const Rounded& body, const Vec3& direction) {
  FC_TODO("1.4");
}

Vec3 difference_support(const Rounded& a, const Rounded& b, const Vec3& direction) {
  FC_TODO("1.4");
}

Vec3 swept_support(const Rounded& a, const Rounded& b, const Vec3& travel, const Vec3& direction) {
  FC_TODO("1.4");
}

double gap_on_the_way(const Rounded& a, const Rounded& b, const Vec3& travel, const Vec3& n) {
  FC_TODO("1.4");
}

}  // namespace fc::exercises

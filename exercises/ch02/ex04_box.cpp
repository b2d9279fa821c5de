#include "ex04_box.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Box fit_box(std::span<const Vec3> points) {
  FC_TODO("2.4");
}

}  // namespace fc::exercises

#include "ex02_billiard.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Bounce next_bounce(const Ellipse& wall, const Vec2& place, const Vec2& velocity) {
  FC_TODO("4.2");
}

Vec2 reflect(const Ellipse& wall, const Vec2& place, const Vec2& velocity) {
  FC_TODO("4.2");
}

}  // namespace fc::exercises

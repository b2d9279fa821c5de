#include "ex02_stop_points.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

Vec2 stop_by_cone(const Vec2& v, double mu, double g) {
  FC_TODO("6.2");
}

Vec2 stop_by_box(const Vec2& v, double mu, double g) {
  FC_TODO("6.2");
}

Vec2 stop_by_pyramid(const Vec2& v, double mu, double g, int corners) {
  FC_TODO("6.2");
}

Error error_of(const Vec2& way, const Vec2& v, double mu, double g) {
  FC_TODO("6.2");
}

int corners_for(double angle) {
  FC_TODO("6.2");
}

}  // namespace fc::exercises

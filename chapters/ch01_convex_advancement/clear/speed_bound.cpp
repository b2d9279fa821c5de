// 1.8, in its clear form: the directional bound.
#include <algorithm>

#include "ch01_convex_advancement/clear/pieces.hpp"

namespace fc::ca::clear {

// ANCHOR: speed_bound
double speed_bound(const Vec3& n, const Mover& a, const Mover& b, double duration) {
  const double pull = n.dot(a.acceleration - b.acceleration);
  const double straight = n.dot(a.velocity - b.velocity) + std::max(0.0, pull * duration);
  const double turning = n.cross(a.spin).norm() * a.reach + n.cross(b.spin).norm() * b.reach;
  return straight + turning;
}
// ANCHOR_END: speed_bound

}  // namespace fc::ca::clear

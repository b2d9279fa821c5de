#include "ch06_friction/contact_block.hpp"

#include <cmath>

namespace fc::friction {
Mat3 contact_frame(const Vec3& normal) {
  Mat3 frame;
  frame.col(0) = normal;
  frame.col(1) = (std::abs(normal.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY()).cross(normal).normalized();
  frame.col(2) = normal.cross(frame.col(1));
  return frame;
}

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Vec3 ContactBlock::relative_velocity(std::span<const MovedBody> bodies) const {
  const MovedBody &of_a = bodies[index(a)], &of_b = bodies[index(b)];
  return frame.transpose() *
         (of_b.velocity + of_b.spin.cross(arm_b) - of_a.velocity - of_a.spin.cross(arm_a));
}

void ContactBlock::push(std::span<MovedBody> bodies, const Vec3& impulse) const {
  const Vec3 p = frame * impulse;
  MovedBody &of_a = bodies[index(a)], &of_b = bodies[index(b)];
  of_a.velocity -= of_a.move.cwiseProduct(p);
  of_a.spin -= of_a.turn * arm_a.cross(p);
  of_b.velocity += of_b.move.cwiseProduct(p);
  of_b.spin += of_b.turn * arm_b.cross(p);
}

}  // namespace fc::friction

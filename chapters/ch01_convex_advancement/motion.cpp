#include "ch01_convex_advancement/motion.hpp"

namespace fc::ca {

Mat3 rotation_about(const Vec3& axis, double angle) {
  const double s = std::sin(angle);
  const double half = std::sin(0.5 * angle);
  const double c = 2 * half * half;  // 1 - cos(angle), without the cancellation
  const double x = axis.x(), y = axis.y(), z = axis.z();
  Mat3 r;
  r << 1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y,  //
      c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x,   //
      c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y);
  return r;
}

double decayed_square(double k, double t) {
  // (x - 1 + e^-x)/x^2 t^2 with x = k t, as a series where the difference would lose digits.
  const double x = k * t;
  if (x > 0.5) return (x + std::expm1(-x)) / (k * k);
  double term = 0.5, sum = 0.5;
  for (int n = 3; n <= 16; ++n) sum += term *= -x / n;
  return t * t * sum;
}

Motion::Motion(const RigidBody& body, const Vec3& acceleration_world)
    : position(body.position),
      rotation(body.orientation.toRotationMatrix()),
      velocity(body.velocity),
      acceleration(acceleration_world),
      spin(body.spin),
      spin_rate(body.spin.norm()) {
  if (spin_rate > 0) spin_axis = spin / spin_rate;
}

Mat3 Motion::rotation_at(double t) const {
  if (free) return free->rotation_at(free_time(t));
  return spin_rate == 0 ? rotation
                        : Mat3(rotation_about(spin_axis, spin_rate * decayed_time(spin_drag, t)) * rotation);
}

Vec3 Motion::position_at(double t) const {
  if (drag > 0) return position + decayed_time(drag, t) * velocity + decayed_square(drag, t) * acceleration;
  return position + t * (velocity + 0.5 * t * acceleration);
}

Vec3 Motion::velocity_at(double t) const {
  if (drag > 0) return std::exp(-drag * t) * velocity + decayed_time(drag, t) * acceleration;
  return velocity + t * acceleration;
}

Vec3 Motion::acceleration_at(double t) const {
  return drag > 0 ? Vec3(std::exp(-drag * t) * (acceleration - drag * velocity)) : acceleration;
}

Vec3 Motion::spin_at(double t) const {
  const Vec3 undamped = free ? Vec3(free_rate * free->spin_at(free_time(t))) : spin;
  return spin_drag > 0 ? Vec3(std::exp(-spin_drag * t) * undamped) : undamped;
}

double Motion::turning_bound(const Vec3& n) const {
  return free ? free_rate * free->turning_bound(n) : n.cross(spin).norm();
}

Vec3 relative_acceleration(const Motion& a, const Motion& b, double t) {
  if (a.drag == 0 && b.drag == 0) return a.acceleration - b.acceleration;
  return a.acceleration_at(t) - b.acceleration_at(t);
}
Vec3 relative_velocity(const Motion& a, const Motion& b, double t) {
  if (a.drag == 0 && b.drag == 0) return (a.velocity - b.velocity) + t * (a.acceleration - b.acceleration);
  if (a.drag == b.drag) {
    const double decay = std::exp(-a.drag * t), grown = decayed_time(a.drag, t);
    return decay * (a.velocity - b.velocity) + grown * (a.acceleration - b.acceleration);
  }
  return a.velocity_at(t) - b.velocity_at(t);
}

PairPose::PairPose(const Motion& a, const Motion& b, double t)
    : rotation_a(a.rotation_at(t)),
      rotation_b(b.rotation_at(t)),
      turned_a(a.turned(t)),
      turned_b(b.turned(t)) {
  const Vec3 position = b.position - a.position, velocity = b.velocity - a.velocity;
  const Vec3 acceleration = b.acceleration - a.acceleration;
  if (a.drag == 0 && b.drag == 0)
    offset_world = position + t * (velocity + (0.5 * t) * acceleration);
  else if (a.drag == b.drag)
    offset_world = position + decayed_time(a.drag, t) * velocity + decayed_square(a.drag, t) * acceleration;
  else
    offset_world = position + (b.position_at(t) - b.position) - (a.position_at(t) - a.position);
  travelled = position.norm() + t * (velocity.norm() + (0.5 * t) * acceleration.norm());
  b_in_a.rotation = rotation_a.transpose() * rotation_b;
  b_in_a.position = rotation_a.transpose() * offset_world;
}

PairPose::PairPose(const Pose& a, const Pose& b)
    : rotation_a(a.rotation),
      rotation_b(b.rotation),
      offset_world(b.position - a.position),
      b_in_a{a.rotation.transpose() * b.rotation, a.rotation.transpose() * offset_world},
      travelled(offset_world.norm()),
      turned_a(0),
      turned_b(0) {}

}  // namespace fc::ca

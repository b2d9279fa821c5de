// Caught by: Ex03SweptBox.IsNoLargerThanTheBalls
// A corner gets no farther than its speed allows: so it is, and after some turns that is farther than the
// ball.
#include "ex03_swept_box.hpp"

#include <algorithm>

namespace fc::exercises {
namespace {

struct Interval {
  double low, high;
  void hold(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// Of x + v t + a t^2 / 2 for t in [0, dt].
Interval of_path(double x, double v, double a, double dt) {
  Interval range{x, x};
  range.hold(x + dt * (v + 0.5 * a * dt));
  const double turn = a == 0 ? -1 : -v / a;
  if (turn > 0 && turn < dt) range.hold(x + turn * (v + 0.5 * a * turn));
  return range;
}

}  // namespace

world::Bounds swept_box(const Vec3& half, const RigidBody& start, const Vec3& acceleration, double dt) {
  const double rate = start.spin.norm();
  const Vec3 axis = rate > 0 ? Vec3(start.spin / rate) : Vec3(Vec3::UnitX());
  world::Bounds box;
  for (int i = 0; i < 3; ++i) {
    const Interval path = of_path(start.position[i], start.velocity[i], acceleration[i], dt);
    Interval turn{0, 0};
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Vec3 arm = start.orientation * half.cwiseProduct(signs);
      const double distance = axis.cross(arm).norm() * rate * dt;
      turn.hold(arm[i] - distance);
      turn.hold(arm[i] + distance);
    }
    box.low[i] = path.low + turn.low;
    box.high[i] = path.high + turn.high;
  }
  return box;
}

}  // namespace fc::exercises

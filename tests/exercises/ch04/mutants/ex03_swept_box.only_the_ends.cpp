// Caught by: Ex03SweptBox.OfABlockThatTurnsALittle
// The block at both ends of the frame.
#include "ex03_swept_box.hpp"

#include <algorithm>
#include <cmath>

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

// Of A + B cos(phi) + C sin(phi) for phi in [0, angle].
Interval of_turn(double A, double B, double C, double angle) {
  Interval range{A + B, A + B};
  range.hold(A + B * std::cos(angle) + C * std::sin(angle));
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
      const Vec3 along = axis.dot(arm) * axis;  // Rodrigues: this part stays, the others go round
      const Interval one = of_turn(along[i], arm[i] - along[i], axis.cross(arm)[i], rate * dt);
      turn.hold(one.low);
      turn.hold(one.high);
    }
    box.low[i] = path.low + turn.low;
    box.high[i] = path.high + turn.high;
  }
  return box;
}

}  // namespace fc::exercises

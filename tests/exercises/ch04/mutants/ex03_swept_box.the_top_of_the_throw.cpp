// Caught by: Ex03SweptBox.OfABlockThatFlies
// A parabola has its ends, and is taken for a line.
#include "ex03_swept_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  return range;
}

// Of A + B cos(phi) + C sin(phi) for phi in [0, angle].
Interval of_turn(double A, double B, double C, double angle) {
  Interval range{A + B, A + B};
  range.hold(A + B * std::cos(angle) + C * std::sin(angle));
  const double size = std::hypot(B, C), crest = std::atan2(C, B);  // where it is largest
  const auto passes = [&](double phi) {
    const double round = 2 * std::numbers::pi;
    return phi - round * std::floor(phi / round) <= angle;
  };
  if (passes(crest)) range.hold(A + size);
  if (passes(crest + std::numbers::pi)) range.hold(A - size);
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

// Caught by: Ex01Zeno.ThrownDownHardFromClose
// The time of the first touch is a difference of nearly equal numbers if the ball is thrown down.
#include "ex01_zeno.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {
namespace {

BallState flying(double height, double velocity, double gravity, double t, std::int64_t bounces) {
  return {std::max(0.0, height + t * (velocity - 0.5 * gravity * t)), velocity - gravity * t, bounces, false};
}

}  // namespace

BallState ball_at(const Drop& drop, double t) {
  const double e = drop.restitution, g = drop.gravity;
  // The first touch: a fall of its own, which is not a part of the series. Of a ball that is thrown down v +
  // hit is a difference of nearly equal numbers; multiplied by (hit - v) above and below it is none.
  const double v = drop.velocity, hit = std::hypot(v, std::sqrt(2 * g * drop.height));
  const double first = (v + hit) / g;
  if (t < first) return flying(drop.height, drop.velocity, g, t, 0);
  const double since = t - first, speed = e * hit;  // after the first bounce
  const double arc = 2 * speed / g;                 // s, the first one; each next is e times as long
  if (arc == 0) return {0, 0, -1, true};

  // After k arcs the part e^k is left of the time until Zeno: so k = log(left) / log(e).
  const double gap = 1 - e, log_e = std::log(e), spent = since * gap / arc;
  if (spent >= 1) return {0, 0, -1, true};
  const auto start_of = [&](double k) { return gap > 0 ? arc * -std::expm1(k * log_e) / gap : k * arc; };
  constexpr double kMost = 1e18 - 1;
  double k = std::min(kMost, std::floor(gap > 0 ? std::log1p(-spent) / log_e : since / arc));
  // Rounding may have put it one off. Not in a loop: just before Zeno all arcs start at the same double.
  if (k > 0 && start_of(k) > since) {
    --k;
  } else if (k < kMost && start_of(k + 1) <= since) {
    ++k;
  }
  const double part = std::exp(k * log_e);
  const double into = std::clamp(since - start_of(k), 0.0, part * arc);
  return flying(0, part * speed, g, into, static_cast<std::int64_t>(k) + 1);
}

}  // namespace fc::exercises

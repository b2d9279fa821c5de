// Caught by: Ex01Zeno.FromBounceToBounce
// The logarithm is rounded to the nearest arc, and nobody looks whether it is the right one.
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
  // The first touch: a fall of its own, which is not a part of the series.
  const double hit = std::sqrt(drop.velocity * drop.velocity + 2 * g * drop.height);
  const double first = (drop.velocity + hit) / g;
  if (t < first) return flying(drop.height, drop.velocity, g, t, 0);
  const double since = t - first, speed = e * hit;  // after the first bounce
  if (speed == 0) return {0, 0, -1, true};
  const double arc = 2 * speed / g;  // s, the first one; each next is e times as long

  // After k arcs the part e^k is left of the time until Zeno: so k = log(left) / log(e).
  const double gap = 1 - e, log_e = std::log(e), spent = since * gap / arc;
  if (spent >= 1) return {0, 0, -1, true};
  const auto start_of = [&](double k) { return gap > 0 ? arc * -std::expm1(k * log_e) / gap : k * arc; };
  double k = std::round(gap > 0 ? std::log1p(-spent) / log_e : since / arc);
  const double part = std::exp(k * log_e);
  const double into = std::clamp(since - start_of(k), 0.0, part * arc);
  return flying(0, part * speed, g, into, static_cast<std::int64_t>(k) + 1);
}

}  // namespace fc::exercises

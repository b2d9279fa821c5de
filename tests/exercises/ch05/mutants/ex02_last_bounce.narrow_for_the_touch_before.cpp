// Caught by: Ex02LastBounce.TheNarrowestForSoManyBounces
// Touches are counted from one.
#include "ex02_last_bounce.hpp"

#include <cmath>
#include <limits>

namespace fc::exercises {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

Ending ending(const Drop& drop, double width, double dt) {
  const double e = drop.restitution, g = drop.gravity;
  const double first = std::sqrt(2 * drop.height / g), u = g * first, slow = width / dt;
  if (e == 1 && u > slow) return {-1, kInfinity, 0, 0};

  // The smallest k with u e^k <= slow. Rounding may have put the logarithm one off.
  double k = 0;
  if (u > slow) {
    k = e > 0 ? std::ceil(std::log(slow / u) / std::log(e)) : 1;
    if (u * std::pow(e, k) > slow) {
      ++k;
    } else if (u * std::pow(e, k - 1) <= slow) {
      --k;
    }
  }
  const double speed = u * std::pow(e, k);
  Ending ending;
  ending.bounces = static_cast<std::int64_t>(k);
  ending.time = first;
  // 2 u (e + e^2 + ... + e^k) / g
  if (k > 0 && e > 0) ending.time += 2 * u / g * e * -std::expm1(k * std::log(e)) / (1 - e);
  ending.cut = e == 1 ? kInfinity : 2 * e * speed / (g * (1 - e));
  ending.energy = 0.5 * speed * speed;
  return ending;
}

double widest_envelope(double restitution, double gravity, double dt) {
  // The worst touch comes with just h/dt: 2 e (h/dt) / (g (1 - e)) = dt.
  return restitution > 0 ? gravity * dt * dt * (1 - restitution) / (2 * restitution) : kInfinity;
}

double narrowest_envelope(const Drop& drop, double dt, std::int64_t bounces) {
  const double u = std::sqrt(2 * drop.gravity * drop.height);
  return dt * u * std::pow(drop.restitution, static_cast<double>(bounces - 1));
}

double shortest_frame(double restitution, double gravity, double least) {
  return std::sqrt(2 * restitution * least / (gravity * (1 - restitution)));
}

}  // namespace fc::exercises

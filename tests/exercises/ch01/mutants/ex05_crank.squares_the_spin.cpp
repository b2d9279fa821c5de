// Caught by: Ex05Crank.ASlowPinTurnsAllTheSame
// Right, but the square of a small spin is 0: then there is no bend, and what recedes recedes for ever.
#include "ex05_crank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::exercises {

double gap(const Crank& crank, double t) {
  return crank.clearance - crank.arm * std::sin(crank.angle + crank.spin * t);
}

double safe_step(const Crank& crank, double t, double target) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (crank.spin == 0 || crank.clearance - crank.arm >= target) return never;
  const double room = gap(crank, t) - target;
  const double c = crank.arm * crank.spin * std::cos(crank.angle + crank.spin * t);
  const double k = 0.5 * crank.arm * crank.spin * crank.spin;
  const double root = std::sqrt(c * c + 4 * k * room);
  const double parabola = c > 0 ? 2 * room / (c + root) : (root - c) / (2 * k);
  return std::max(parabola, room / (crank.arm * std::abs(crank.spin)));
}

}  // namespace fc::exercises

#include "ex05_crank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::exercises {

double gap(const Crank& crank, double t) {
  return crank.clearance - crank.arm * std::sin(crank.angle + crank.spin * t);
}

// |d2 gap / dt2| = arm spin^2 |sin| <= 2 k, so gap(t + h) >= gap - c h - k h^2. In radians of turn, x =
// |spin| h, and in arms, that is room - s x - x^2/2 with s the sine of the way towards the ceiling: there a
// spin of 1e-170 rad/s has no square that vanishes. The parabola's only root after now is -s + sqrt(s^2 + 2
// room). Written like this it subtracts nearly equal numbers where s > 0 and the room is small; multiplied by
// (s + sqrt) above and below it does not.
double safe_step(const Crank& crank, double t, double target) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (crank.spin == 0 || crank.clearance - crank.arm >= target) return never;
  const double room = (gap(crank, t) - target) / crank.arm;
  const double s = std::copysign(1, crank.spin) * std::cos(crank.angle + crank.spin * t);
  const double root = std::sqrt(s * s + 2 * room);
  const double parabola = s > 0 ? 2 * room / (s + root) : root - s;
  return std::max(parabola, room) / std::abs(crank.spin);
}

}  // namespace fc::exercises

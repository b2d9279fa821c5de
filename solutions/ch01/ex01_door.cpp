#include "ex01_door.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::exercises {

// A point at r from the hinge moves with w(s) axis x r. Along n that is w(s) (n x axis) . r, and since n x
// axis is perpendicular to the axis, only the part of r that is so too counts: its length is the distance
// from the hinge's line, which no turn about that line changes. |w| is largest at one of the ends, w being
// linear in time.
double door_speed_bound(const Door& door, const Vec3& n, double t, double end) {
  double across = 0, far = 0;
  for (const Vec3& corner : door.corners) {
    const Vec3 r = corner - door.hinge;
    across = std::max(across, r.cross(door.axis).norm());
    far = std::max(far, r.norm());
  }
  const double fastest =
      std::max(std::abs(door.spin + door.spin_up * t), std::abs(door.spin + door.spin_up * end));

  // Each of the three factors comes out of differences, in which rounding is a part of what was subtracted,
  // not of what is left.
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  return (fastest + kRounding * (std::abs(door.spin) + std::abs(door.spin_up) * end)) *
         (n.cross(door.axis).norm() + kRounding) * (across + kRounding * far);
}

}  // namespace fc::exercises

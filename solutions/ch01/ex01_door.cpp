#include "ex01_door.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

// A point at r from the hinge moves with w(s) axis x r. Along n that is w(s) (n x axis) . r, and since n x
// axis is perpendicular to the axis, only the part of r that is so too counts: its length is the distance
// from the hinge's line, which no turn about that line changes. |w| is largest at one of the ends, w being
// linear in time.
double door_speed_bound(const Door& door, const Vec3& n, double t, double end) {
  double across = 0;
  for (const Vec3& corner : door.corners)
    across = std::max(across, (corner - door.hinge).cross(door.axis).norm());
  const double fastest =
      std::max(std::abs(door.spin + door.spin_up * t), std::abs(door.spin + door.spin_up * end));
  return fastest * n.cross(door.axis).norm() * across;
}

}  // namespace fc::exercises

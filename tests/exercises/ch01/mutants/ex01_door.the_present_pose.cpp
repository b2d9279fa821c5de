// Caught by: Ex01Door.IsNeverExceeded
// The corners where they are at s = 0: they turn.
#include <algorithm>
#include <cmath>

#include "ex01_door.hpp"

namespace fc::exercises {

double door_speed_bound(const Door& door, const Vec3& n, double t, double end) {
  double across = 0;
  for (const Vec3& corner : door.corners)
    across = std::max(across, n.cross(door.axis).normalized().dot(corner - door.hinge));
  const double fastest =
      std::max(std::abs(door.spin + door.spin_up * t), std::abs(door.spin + door.spin_up * end));
  return fastest * n.cross(door.axis).norm() * across;
}

}  // namespace fc::exercises

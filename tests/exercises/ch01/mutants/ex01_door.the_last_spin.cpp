// Caught by: Ex01Door.SeesASpinThatBrakes
// The spin at the end, as if it only grew.
#include <algorithm>
#include <cmath>

#include "ex01_door.hpp"

namespace fc::exercises {

double door_speed_bound(const Door& door, const Vec3& n, double t, double end) {
  double across = 0;
  for (const Vec3& corner : door.corners)
    across = std::max(across, (corner - door.hinge).cross(door.axis).norm());
  const double fastest = std::abs(door.spin + door.spin_up * end);
  return fastest * n.cross(door.axis).norm() * across;
}

}  // namespace fc::exercises

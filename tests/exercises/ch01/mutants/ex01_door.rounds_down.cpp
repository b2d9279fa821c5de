// Caught by: Ex01Door.NoPointExceedsItByTheLastDigitEither
// Right but for rounding, which makes half of all results smaller than the truth.
#include "ex01_door.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {

double door_speed_bound(const Door& door, const Vec3& n, double t, double end) {
  double across = 0;
  for (const Vec3& corner : door.corners)
    across = std::max(across, (corner - door.hinge).cross(door.axis).norm());
  const double fastest =
      std::max(std::abs(door.spin + door.spin_up * t), std::abs(door.spin + door.spin_up * end));
  return fastest * n.cross(door.axis).norm() * across;
}

}  // namespace fc::exercises

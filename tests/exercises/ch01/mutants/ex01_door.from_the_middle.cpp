// Caught by: Ex01Door.IsNeverExceeded
// The distance from the corners' middle, as if the door turned about it.
#include <algorithm>
#include <cmath>

#include "ex01_door.hpp"

namespace fc::exercises {

double door_speed_bound(const Door& door, const Vec3& n, double t, double end) {
  double across = 0;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& corner : door.corners) middle += corner / static_cast<double>(door.corners.size());
  for (const Vec3& corner : door.corners)
    across = std::max(across, (corner - middle).cross(door.axis).norm());
  const double fastest =
      std::max(std::abs(door.spin + door.spin_up * t), std::abs(door.spin + door.spin_up * end));
  return fastest * n.cross(door.axis).norm() * across;
}

}  // namespace fc::exercises

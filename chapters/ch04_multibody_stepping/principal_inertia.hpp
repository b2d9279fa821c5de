// A body's principal moments of inertia, and the axes that belong to them.
#pragma once

#include "common/types.hpp"

namespace fc::world {

// Found once per body: free rotation is simple in these axes.
struct PrincipalInertia {
  Vec3 moments;  // kg m^2, about the centre of mass; I1 <= I2 <= I3
  Mat3 axes;     // columns: the principal axes in body axes, right-handed

  // From the inertia tensor (kg m^2, about the centre of mass, body axes). Throws std::invalid_argument, with the
  // numbers, unless it is finite, symmetric (to 1e-12 of its largest entry), positive, and possible for a mass: I3 <=
  // I1 + I2 (to 1e-9).
  explicit PrincipalInertia(const Mat3& inertia);
};

}  // namespace fc::world

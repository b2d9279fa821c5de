// What flat sides do to friction: a block slides freely on a plane, by each method, compared with the cone.
#pragma once

#include "ch06_friction/friction_solver.hpp"

namespace fc::friction {

// A law of friction: a method, and for a pyramid its number of sides, which are not turned.
struct FrictionLaw {
  Method method = Method::combined;
  int sides = 8;
};

// Where a block stops that begins with 1 m/s at `angle` (rad) from tangent 1, by one solve of one contact per step.
// Length 1 is the exact distance v²/(2µg); the exact answer is (cos angle, sin angle), up to the distance of one step.
//   steps: in the exact time v/(µg), > 0.
Eigen::Vector2d stopping_point(const FrictionLaw& law, double angle, int steps);

// The worst over `angles` > 1 directions from 0 to 90°.
struct FacetErrors {
  double direction = 0;              // rad, of the stopping point from the velocity
  double direction_at = 0;           // rad, the angle where this occurs
  double shortest = 1, longest = 1;  // distances, 1 is exact
};
FacetErrors facet_errors(const FrictionLaw& law, int angles, int steps);

}  // namespace fc::friction

// Exercise 4.5: rotation without torque by steps that lose nothing: the implicit midpoint rule.
#pragma once

#include "common/types.hpp"

namespace fc::exercises {

// A body on which no torque acts, in its principal axes.
struct Tumbler {
  Vec3 moments = Vec3::Ones();       // kg m^2, about the centre of mass, > 0; none larger than the sum of the
                                     //   other two, or than 100 times another (a thinner body is a needle)
  Mat3 rotation = Mat3::Identity();  // principal axes to world axes
  Vec3 momentum = Vec3::Zero();      // kg m^2/s, the angular momentum in principal axes: moments times spin
};

// One step of h seconds (either sign; |h| times the spin at most 0.5 rad). Euler's equations seen from the
// body are dL/dt = L x w with w = L / moments. The step solves
//   L1 = L0 + h Lm x wm,   Lm = (L0 + L1)/2,   wm = Lm / moments
// to rounding, and turns the body by wm so that the angular momentum in the world, rotation * momentum, is kept.
// Guarantees: |L|, the kinetic energy and the angular momentum in the world are kept to rounding; the error of the
// orientation at a fixed time falls as h^2; a step back undoes a step. Returns how often the right-hand side was
// evaluated, at most 40: the iteration ends when it changes nothing but rounding.
int step(Tumbler& body, double h);

}  // namespace fc::exercises

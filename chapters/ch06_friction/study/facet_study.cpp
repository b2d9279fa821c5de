#include "ch06_friction/study/facet_study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fc::friction {

Eigen::Vector2d stopping_point(const FrictionLaw& law, double angle, int steps) {
  // Mass, µ and g are 1: the exact time is 1, and the distance 1/2.
  const double dt = 1.0 / steps;
  const MatX A = MatX::Identity(3, 3);
  const VecX mu = VecX::Ones(1);
  VecX b{{-dt, std::cos(angle), std::sin(angle)}};
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  for (int step = 0; step < 2 * steps && !b.tail<2>().isZero(1e-12); ++step) {
    const ConeResult result = solve({A, b, mu}, law.method, {.sides = law.sides, .turned = false});
    // The mean of the velocities before and after, as with constant forces.
    position += 0.5 * dt * (b.tail<2>() + result.u.tail<2>());
    b.tail<2>() = result.u.tail<2>();
  }
  return 2 * position;
}

FacetErrors facet_errors(const FrictionLaw& law, int angles, int steps) {
  FacetErrors worst;
  for (int k = 0; k < angles; ++k) {
    const double angle = 0.5 * std::numbers::pi * k / (angles - 1);
    const Eigen::Vector2d stop = stopping_point(law, angle, steps);
    const double off = std::abs(std::atan2(stop[1], stop[0]) - angle);
    if (off > worst.direction) {
      worst.direction = off;
      worst.direction_at = angle;
    }
    worst.shortest = std::min(worst.shortest, stop.norm());
    worst.longest = std::max(worst.longest, stop.norm());
  }
  return worst;
}

}  // namespace fc::friction

// Caught by: Ex01Zeno.CountsMoreThanALoopCould
// A loop over the bounces, and a million of them are taken for all.
#include "ex01_zeno.hpp"

#include <cmath>

namespace fc::exercises {

BallState ball_at(const Drop& drop, double t) {
  constexpr std::int64_t kAll = 1'000'000;
  const double g = drop.gravity;
  double height = drop.height, velocity = drop.velocity;
  for (std::int64_t bounces = 0; bounces < kAll; ++bounces) {
    const double hit = std::sqrt(velocity * velocity + 2 * g * height), fall = (velocity + hit) / g;
    if (t < fall) return {height + t * (velocity - 0.5 * g * t), velocity - g * t, bounces, false};
    t -= fall;
    height = 0;
    velocity = drop.restitution * hit;
  }
  return {0, 0, -1, true};
}

}  // namespace fc::exercises

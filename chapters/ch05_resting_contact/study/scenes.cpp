// What is measured in each scene.
#include <algorithm>
#include <cmath>

#include "ch05_resting_contact/study/parts.hpp"

namespace fc::resting {

BallResult measure_ball(Setting setting, int repeats, const Look& look) {
  constexpr double kSlow = 1e-3;  // m/s: below it the ball is still; so it is if it is frozen
  setting.seconds = 2;
  BallResult result;
  double moved = 0;
  result.run = run(setting, repeats, [&](const world::World& world, const Frame& frame) {
    const RigidBody& ball = world.bodies[1].state;
    result.place_error = std::abs(ball.position.z() - 0.5 - ball_height(frame.t));
    result.height_error = std::max(result.height_error, result.place_error);
    if (std::abs(ball.velocity.z()) > kSlow && frame.lost < 0.5 * setting.dt) moved = frame.t;
    result.energy_error = energy_of(world) - kGravity * 0.5;
    if (look) look(world, frame);
  });
  result.rest_error = moved - zeno_time();
  return result;
}

SlopeResult measure_slope(Setting setting, int repeats, const Look& look) {
  setting.seconds = 2;
  const double along = kGravity * std::sin(kSlope), across = kGravity * std::cos(kSlope);
  SlopeResult result;
  double start = 0;
  result.run = run(setting, repeats, [&](const world::World& world, const Frame& frame) {
    const Vec3& place = world.bodies[1].state.position;
    result.way_error = place.x() - 0.5 * along * frame.t * frame.t;
    if (frame.t < 1) start = place.z();
    result.drift = std::max(result.drift, std::abs(place.z() - start));
    result.energy_error = energy_of(world) - across * 0.5;
    if (frame.t < 1) result.drift = 0;
    if (look) look(world, frame);
  });
  return result;
}

StackResult measure_stack(Setting setting, int repeats, const Look& look) {
  constexpr double kSettled = 2;  // s
  setting.seconds = 3;
  StackResult result;
  std::vector<Vec3> settled;
  result.run = run(setting, repeats, [&](const world::World& world, const Frame& frame) {
    const double error = force_error(frame, kBoxes, setting.dt);
    if (frame.t < 1.5 * setting.dt) result.first_error = error;
    if (frame.t > kSettled) result.force_error = std::max(result.force_error, error);
    if (frame.t <= kSettled + 0.5 * setting.dt) settled.clear();
    result.place_error = 0;
    for (int k = 0; k < kBoxes; ++k) {
      const Vec3& place = world.bodies[static_cast<std::size_t>(k + 1)].state.position;
      if (static_cast<int>(settled.size()) <= k) settled.push_back(place);
      result.drift = std::max(result.drift, (place - settled[static_cast<std::size_t>(k)]).norm());
      result.place_error = std::max(result.place_error, (place - Vec3(0, 0, 0.5 + k)).norm());
    }
    result.energy_error = energy_of(world) - kGravity * 0.5 * kBoxes * kBoxes;
    if (look) look(world, frame);
  });
  return result;
}

}  // namespace fc::resting

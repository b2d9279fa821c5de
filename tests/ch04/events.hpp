// A run of a world, with the times of its impulses counted from the run's start.
#pragma once

#include "support/worlds.hpp"

namespace fc_test {

struct Event {
  double t = 0;  // s
  fc::lcp::Contact contact;
  fc::lcp::Impulse impulse;
};

struct Events {
  std::vector<Event> all;
  std::vector<fc::world::StepReport> reports;
  int instants = 0;  // with an impulse

  double lost_time() const {
    double sum = 0;
    for (const auto& report : reports) sum += report.lost_time;
    return sum;
  }
};

inline Events run_world(fc::world::World& world, double dt, int frames) {
  Events events;
  for (int frame = 0; frame < frames; ++frame)
    events.reports.push_back(
        fc::world::step(world, dt, {.impact = [&](const fc::world::ImpactRecord& record) {
                          const double t = frame * dt + record.time;
                          if (events.all.empty() || events.all.back().t != t) ++events.instants;
                          events.all.push_back({t, record.contact, record.impulse});
                        }}));
  return events;
}

inline double kinetic_energy(const fc::world::World& world) {
  double sum = 0;
  for (const auto& body : world.bodies) sum += body.state.kinetic_energy();
  return sum;
}

inline double energy(const fc::world::World& world) {
  double sum = kinetic_energy(world);
  if (world.effects.gravity)
    for (const auto& body : world.bodies)
      sum -= body.state.mass * world.effects.gravity->dot(body.state.position);
  return sum;
}

inline const fc::RigidBody& body(const fc::world::World& world, int i) {
  return world.bodies[i].state;
}

// Nothing that a world promises in every frame was broken.
inline void expect_sound(const Events& events) {
  for (const auto& report : events.reports) {
    EXPECT_LE(report.lcp_residual, 1e-10);
    EXPECT_LE(report.momentum_error, 1e-10);
    EXPECT_GE(report.lost_time, 0);
  }
}

inline const std::string balls = R"(
step: {dt: 0.01, duration: 1}
ccd: {tolerance: 1.0e-9}
restitution: 1
shapes:
  ball: {sphere: {radius: 0.5}, mass: 1}
  heavy: {sphere: {radius: 0.5}, mass: 3}
  wall: {box: {size: [1, 4, 4]}}
  floor: {box: {size: [10, 10, 1]}}
  brick: {box: {size: [1, 0.8, 0.6]}, mass: 2}
bodies:
)";

}  // namespace fc_test

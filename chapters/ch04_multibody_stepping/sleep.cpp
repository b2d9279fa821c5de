#include "ch04_multibody_stepping/sleep.hpp"

#include <algorithm>

namespace fc::world {

void fall_asleep(World& world, double dt, StepReport& report) {
  const SleepSpec& sleep = *world.effects.sleep;
  for (Body& body : world.bodies) {
    if (body.asleep) continue;
    body.still = body.frozen && body.lies ? body.still + (dt - body.time) : 0;
    const double speed = body.state.velocity.norm() +
                         body.state.spin.norm() * world.shapes[static_cast<std::size_t>(body.shape)].reach;
    if (body.still < sleep.after || speed > sleep.speed) continue;
    report.slept_energy += body.state.kinetic_energy();
    ++report.falls_asleep;
    body.state.velocity = body.state.spin = Vec3::Zero();
    body.free.reset();
    body.asleep = true;
  }
}

void wake(World& world, double now, std::vector<int>& bodies, StepReport& report) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int body = bodies[i];
    if (!world.bodies[body].asleep) continue;
    world.bodies[body].asleep = false;
    world.bodies[body].time = now;
    world.bodies[body].still = 0;
    ++report.wakes;
    world.schedule.overlapping(world.swept_bounds(body, now, now), [&](int other) {
      if (world.bodies[other].asleep && std::find(bodies.begin(), bodies.end(), other) == bodies.end())
        bodies.push_back(other);
    });
  }
}

}  // namespace fc::world

#include "ch05_resting_contact/planned.hpp"

#include <algorithm>
#include <utility>

namespace fc::resting {

// ANCHOR: planned_motion
world::Plan planned_motion(const Member& member, const Twist& path, const Twist& end, double length) {
  world::Plan motion;
  motion.linear = path.linear;
  motion.angular = path.angular;
  motion.push = (end.linear - member.state.velocity) / length;
  motion.turn = (end.angular - member.state.spin) / length;
  return motion;
}
// ANCHOR_END: planned_motion

double RunningPlans::next_end() const {
  double first = std::numeric_limits<double>::infinity();
  for (const RunningPlan& plan : plans_)
    if (plan.what) first = std::min(first, plan.end);
  return first;
}

std::vector<int> RunningPlans::bodies_until(double now) const {
  std::vector<int> bodies;
  for (const RunningPlan& plan : plans_)
    if (plan.what && plan.end <= now)
      bodies.insert(bodies.end(), plan.what->bodies.begin(), plan.what->bodies.end());
  return bodies;
}

void RunningPlans::start(world::World& world, RunningPlan plan) {
  if (free_.empty()) {
    free_.push_back(static_cast<int>(plans_.size()));
    plans_.emplace_back();
  }
  const int number = free_.back();
  free_.pop_back();
  for (std::size_t i = 0; i < plan.what->bodies.size(); ++i) {
    world::Plan& motion = world.bodies[at(plan.what->bodies[i])].plan;
    motion = plan.what->motions[i];
    motion.number = number;
  }
  plans_[at(number)] = std::move(plan);
}

RunningPlan RunningPlans::end(world::World& world, int number, double now) {
  RunningPlan plan = std::exchange(plans_[at(number)], {});
  free_.push_back(number);
  for (std::size_t i = 0; i < plan.what->bodies.size(); ++i) {
    world::Body& body = world.bodies[at(plan.what->bodies[i])];
    world.advance_to(plan.what->bodies[i], now, now);
    body.plan = {};
    if (now < plan.end) continue;
    body.state.velocity += plan.what->arrivals[i].linear;
    body.state.spin += plan.what->arrivals[i].angular;
  }
  return plan;
}

}  // namespace fc::resting

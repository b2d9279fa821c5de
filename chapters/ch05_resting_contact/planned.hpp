// A finished plan, and the plans that bodies follow, each in its own time.
#pragma once

#include <memory>

#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// A row of a plan, and what it does: for contacts.csv.
struct PlannedRow {
  lcp::Contact contact;  // bodies by their numbers in the world
  // N s, on B: all of the plan; the part that acts evenly all the time, not at the end; what it gives back at the end.
  Vec3 impulse = Vec3::Zero(), early = Vec3::Zero(), back = Vec3::Zero();
  // m/s, of B's point relative to A's, without and with the plan's impulses.
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  std::uint64_t key = 0;  // of its point
  int patch = -1;         // see world::ImpactRecord
  bool arrives = false;   // not in contact at the start: its impulse acts at the plan's end
};

// What a plan does to its bodies. An event may end it early. Then only that share of what acts all the time has acted,
// and nothing of what acts at its end: the arrivals, and what they cause.
struct Planned {
  std::vector<int> bodies;  // by their numbers in the world
  std::vector<world::Plan> motions;
  std::vector<Twist> arrivals;                // what velocities gain at the plan's end
  int pushing = 0;                            // contacts with an impulse,
  std::vector<PlannedRow> rows;               // and what they do
  double kinematic_work = 0, early_work = 0;  // J, done by kinematic bodies, in all and all the time
  double correction = 0;                      // m, the most that gap correction moves a point of a body
};

// A motion whose velocities begin as the member's and end as `end`, without what the body gets on arrival.
world::Plan planned_motion(const Member& member, const Twist& path, const Twist& end, double length);

struct RunningPlan {
  double start = 0, end = 0;            // s in the frame
  std::shared_ptr<const Planned> what;  // null: it has ended
};

class RunningPlans {
 public:
  double next_end() const;                            // s in the frame; infinite if none runs
  std::vector<int> bodies_until(double now) const;    // of the plans that end until now
  void start(world::World& world, RunningPlan plan);  // its bodies follow it
  // The plan of this number ends, or is cut short: its bodies get their present poses and velocities.
  RunningPlan end(world::World& world, int number, double now);

 private:
  std::vector<RunningPlan> plans_;  // by their numbers
  std::vector<int> free_;           // numbers of those that have ended
};

}  // namespace fc::resting

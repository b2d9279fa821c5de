// A plan that was made, and the plans that bodies go by, each in its own time.
#pragma once

#include <memory>

#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// A row of a plan, and what it does: for contacts.csv.
struct PlannedRow {
  lcp::Contact contact;  // bodies by their numbers in the world
  // N s, on B: of the whole plan; of it what acts evenly all the time, and not at its end; what it gives back at the plan's end.
  Vec3 impulse = Vec3::Zero(), early = Vec3::Zero(), back = Vec3::Zero();
  // m/s, of B's point as seen from A's, without and with the plan's impulses.
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  std::uint64_t key = 0;  // of its point
  int patch = -1;         // see world::ImpactRecord
  bool arrives = false;   // it was not in contact at the start: what it does, it does at the plan's end
};

// What a plan's bodies do. An event may end it before its time: then only that share of what acts all the time has acted, and
// nothing of what acts at its end: what arrives there, and what that causes.
struct Planned {
  std::vector<int> bodies;  // by their numbers in the world
  std::vector<world::Plan> motions;
  std::vector<Twist> arrivals;                // what velocities get at the plan's end
  int pushing = 0;                            // contacts with an impulse,
  std::vector<PlannedRow> rows;               // and what they do
  double kinematic_work = 0, early_work = 0;  // J, done by kinematic bodies, in all and all the time
  double correction = 0;                      // m, by which a body's point is moved at most to put gaps right
};

// A motion of which velocities begin as the member's and end as `end`, without what it gets on arrival.
world::Plan planned_motion(const Member& member, const Twist& path, const Twist& end, double length);

struct RunningPlan {
  double start = 0, end = 0;            // s in the frame
  std::shared_ptr<const Planned> what;  // none: it has ended
};

class RunningPlans {
 public:
  double next_end() const;                            // s in the frame; infinite if none runs
  std::vector<int> bodies_until(double now) const;    // of the plans that end until now
  void start(world::World& world, RunningPlan plan);  // its bodies go by it
  // The plan of this number ends, or is cut: its bodies stand where they are now, with the velocities that they have.
  RunningPlan end(world::World& world, int number, double now);

 private:
  std::vector<RunningPlan> plans_;  // by their numbers
  std::vector<int> free_;           // numbers of those that have ended
};

}  // namespace fc::resting

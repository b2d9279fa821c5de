// What instants and plans did, reported; contacts that last once in a frame, with both halves of what acts at them.
#pragma once

#include <unordered_map>
#include <vector>

#include "ch05_resting_contact/impact_law.hpp"
#include "ch05_resting_contact/planned.hpp"

namespace fc::resting {

// s: what happens at the end of a frame of dt seconds is reported a little before it, as it belongs to this frame.
double reported_time(double now, double dt);

// An instant, and what is to be reported of it.
struct Instant {
  world::World& world;
  double now;  // s in the frame
  world::StepReport& report;
  const world::Listeners& listeners;
  std::vector<int> bodies = {};   // whose plans end; the list grows
  std::vector<int> changed = {};  // that have got another motion
  double planned = 0;             // s, how long the plans have lasted that end here
  double gained = 0;  // J, by all of them since they got their last, beyond what kinematic bodies did
};

class RestRecords {
 public:
  void add(Instant& instant, const InstantResult& result);
  // What the plan did until now, when it ends, in a frame of dt seconds.
  void add(Instant& instant, const RunningPlan& plan, double dt);
  void report(const world::OnImpact& listener) const;
  // J, what impulses along the surfaces did; those of contacts that last over a plan's path, along which both halves act.
  double tangential_work() const { return impact_work_ + work_; }

 private:
  struct Reported {
    world::ImpactRecord record;
    Vec3 slip;  // m/s, of the last plan
    std::uint64_t key;
    int next;  // of the same two bodies, or -1
  };
  void add(const world::ImpactRecord& record, std::uint64_t key, bool ends_plan);

  std::vector<Reported> records_;
  double impact_work_ = 0, work_ = 0;
  std::unordered_map<std::uint64_t, int> last_of_;  // of two bodies
};

}  // namespace fc::resting

// What instants and plans did, as records; contacts that last get one record a frame, with both halves of their
// impulse.
#pragma once

#include <unordered_map>
#include <vector>

#include "ch05_resting_contact/impact_law.hpp"
#include "ch05_resting_contact/planned.hpp"

namespace fc::resting {

// s: what happens at the end of a frame of dt seconds is reported a little before it, as it belongs to this frame.
double reported_time(double now, double dt);

// An instant, and what it has to report.
struct Instant {
  world::World& world;
  double now;  // s in the frame
  world::StepReport& report;
  const world::Listeners& listeners;
  std::vector<int> bodies = {};   // bodies whose plans end; the list grows
  std::vector<int> changed = {};  // bodies with a new motion
  double planned = 0;             // s, how long the plans that end here have lasted
  double on_plans =
      0;  // J, gained on the plans that end here, beyond the works of friction and kinematic bodies
  double gained =
      0;  // J, gained by all of them since their last motion began, beyond the work of kinematic bodies
};

class RestRecords {
 public:
  void add(Instant& instant, const InstantResult& result);
  // What the plan did until now, where it ends, in a frame of dt seconds.
  void add(Instant& instant, const RunningPlan& plan, double dt);
  void report(const world::OnImpact& listener) const;
  // J, the work of impulses along the surfaces; for contacts that last, over the path of the plan, along which both
  // halves act.
  double tangential_work() const { return impact_work_ + work_; }

 private:
  struct Reported {
    world::ImpactRecord record;
    Vec3 slip;  // m/s, of the last plan
    std::uint64_t key;
    int next;  // the next of the same two bodies, or -1
  };
  void add(const world::ImpactRecord& record, std::uint64_t key, bool ends_plan);

  std::vector<Reported> records_;
  double impact_work_ = 0, work_ = 0;
  std::unordered_map<std::uint64_t, int> last_of_;  // of two bodies
};

}  // namespace fc::resting

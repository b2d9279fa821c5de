// What instants and plans did, reported; contacts that last once in a frame, with both halves of what acts at them.
#pragma once

#include <unordered_map>
#include <vector>

#include "ch05_resting_contact/impact_law.hpp"
#include "ch05_resting_contact/planned.hpp"

namespace fc::resting {

// s: what happens at the end of a frame of dt seconds is reported a little before it, as it belongs to this frame.
double reported_time(double now, double dt);

class RestRecords {
 public:
  void clear();
  void add(const InstantResult& result, world::StepReport& report, const world::Listeners& listeners);
  // What the plan did until now, when it ends.
  void add(const RunningPlan& plan, double now, double dt, world::StepReport& report,
           const world::Listeners& listeners);
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

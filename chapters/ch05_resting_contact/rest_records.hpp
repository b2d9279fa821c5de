// Contacts that last, reported once in a frame: what a plan does to one, and what the instant at the plan's end does.
#pragma once

#include <unordered_map>
#include <vector>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::resting {

// The record of an impulse (N s, world, on B): the velocities of B's point as seen from A's were `before` and are `after` (m/s).
world::ImpactRecord record_of(double time, const lcp::Contact& contact, const Vec3& before, const Vec3& after,
                              const Vec3& impulse, world::ContactKind kind);

class RestRecords {
 public:
  void clear();
  // `key` names the point among those of its two bodies. Added to what is known of it, if its normal has not changed.
  // ends_plan: it is what the instant at a plan's end did, the other half of what the plan did.
  void add(const world::ImpactRecord& record, std::uint64_t key, bool ends_plan);
  void report(const world::OnImpact& listener) const;
  // J, what impulses along the surfaces did: over a plan's path, along which both halves act.
  double tangential_work() const { return work_; }
  int size() const { return static_cast<int>(records_.size()); }

 private:
  struct Reported {
    world::ImpactRecord record;
    Vec3 slip;  // m/s, of the last plan
    std::uint64_t key;
    int next;  // of the same two bodies, or -1
  };
  std::vector<Reported> records_;
  double work_ = 0;
  std::unordered_map<std::uint64_t, int> last_of_;  // of two bodies
};

}  // namespace fc::resting

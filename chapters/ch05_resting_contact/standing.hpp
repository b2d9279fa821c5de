// Islands that stand: what they did in the last frame, they do again.
#pragma once

#include <memory>

#include "ch05_resting_contact/impact_law.hpp"
#include "ch05_resting_contact/plan.hpp"

namespace fc::resting {

// A plan, and what an instant does to velocities, follow from the island alone. So the same island, to the last bit of its
// bodies' poses and velocities, has the same plan again; unless a kinematic body comes by, which the plan has to look at. It is
// kept of islands that have not moved: only they will be the same.
class Standing {
 public:
  explicit Standing(std::size_t bodies) : known_(bodies), passed_(bodies, 0) {}
  // A frame, or a part of it, of dt seconds.
  void begin(const world::World& world, double margin, double dt);

  // The plan for `length` seconds of an island as it is; none if it is not known.
  std::shared_ptr<const Planned> plan(const Island& island, double length) const;
  void keep(const Island& island, double length, const std::shared_ptr<const Planned>& plan);

  // What an instant did to an island as it is, which then gets its velocities afterwards; none if it is not known.
  std::shared_ptr<const InstantResult> instant(Island& island) const;
  // before: the members' states. Kept only if they stand afterwards.
  void keep(const std::vector<Member>& before, const Island& after, const InstantResult& result);

 private:
  struct Known {  // of the island of which a body is the first member
    double length = 0;
    std::vector<Member> at_start, before, after;
    std::shared_ptr<const Planned> plan;
    std::shared_ptr<const InstantResult> instant;
  };
  const Known* known(const Island& island) const;
  Known& made(const std::vector<Member>& members);

  std::vector<std::unique_ptr<Known>> known_;
  std::vector<char> passed_;  // by a kinematic body, in this frame
};

}  // namespace fc::resting

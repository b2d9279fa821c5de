// What stands: bodies whose velocities are only round-off, and islands that repeat the last frame exactly.
#pragma once

#include <algorithm>

#include "ch05_resting_contact/impact_law.hpp"
#include "ch05_resting_contact/planned.hpp"

namespace fc::resting {

// A body in contact whose points are slower than this part of the margin in a frame stands still: such a speed is the
// round-off of impulses that cancel. A body may lose this much in a frame, in all its instants together.
constexpr double kStill = 1e-9;

// m/s, the speed of the body's fastest point.
double fastest_point(const world::World& world, int body, const Vec3& velocity, const Vec3& spin);

// A plan, and an instant's effect on velocities, follow from the island alone. So an island that is the same, to the
// last bit of its bodies' poses and velocities, has the same plan again; unless a kinematic body comes by, which the
// plan has to consider. Plans are kept for islands that have not moved, since only they can be the same again. For this
// purpose their bodies are made to stand exactly.
class Standing {
 public:
  Standing(const ContactLaw& law, double margin, std::size_t bodies)
      : law_(law), margin_(margin), pushed_(bodies), stopped_(bodies), passed_(bodies), known_(bodies) {}
  void next_frame();
  // Knows what `before` knows of the bodies that it has, by the same law and rules.
  void take_over(const Standing& before) {
    std::copy(before.known_.begin(), before.known_.end(), known_.begin());
  }
  // A frame of dt seconds, or a part of one, begins.
  void begin(const world::World& world, double dt);

  // An impulse of this frame, N s: it cancels with others up to a small share of its size. Bodies by their numbers in
  // the world.
  void add(const lcp::Contact& contact, double impulse) {
    for (const int body : {contact.body_a, contact.body_b}) pushed_[at(body)] += impulse;
  }
  // After an instant: removes the rest of velocities that do not move the members.
  void stop(const world::World& world, std::span<Member> members);
  // The same for the paths of bodies that have got a plan. Returns whether all of them stand.
  bool stop(world::World& world, const Planned& plan) const;

  // The plan for `length` seconds of an island in its present state; null if it is not known.
  std::shared_ptr<const Planned> plan(const Island& island, double length) const;
  void keep(const Island& island, double length, const std::shared_ptr<const Planned>& plan);
  // What an instant did to an island in this state, which then gets its velocities afterwards; null if it is not known.
  std::shared_ptr<const InstantResult> instant(Island& island) const;
  // before: the members' states. Stored only if they stand afterwards.
  void keep(const std::vector<Member>& before, const Island& after, const InstantResult& result);

 private:
  struct Known {  // of the island whose first member is the body
    double length = 0;
    std::vector<Member> at_start, before, after;
    std::shared_ptr<const Planned> plan;
    std::shared_ptr<const InstantResult> instant;
  };
  double still_speed(const world::World& world, int body) const;

  const ContactLaw& law_;
  double margin_, dt_ = 0;
  std::vector<double> pushed_;   // N s, the sum of the sizes of all impulses on each body in this frame
  std::vector<double> stopped_;  // m/s, the speed that was taken as rest in this frame
  std::vector<char> passed_;     // a kinematic body came by in this frame
  std::vector<Known> known_;
};

}  // namespace fc::resting

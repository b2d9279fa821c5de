// What stands: bodies whose velocities are only round-off, and islands that do again what they did in the last frame.
#pragma once

#include "ch05_resting_contact/impact_law.hpp"
#include "ch05_resting_contact/planned.hpp"

namespace fc::resting {

// A body in contact whose points are slower than this part of the margin in a frame stands still: below it is round-off of
// impulses that cancel. So much a body may lose in a frame, in all its instants together.
constexpr double kStill = 1e-9;

// m/s, of the fastest of the body's points.
double fastest_point(const world::World& world, int body, const Vec3& velocity, const Vec3& spin);

// A plan, and what an instant does to velocities, follow from the island alone. So the same island, to the last bit of its
// bodies' poses and velocities, has the same plan again; unless a kinematic body comes by, which the plan has to look at. It is
// kept of islands that have not moved: only they will be the same. For this their bodies are made to stand exactly.
class Standing {
 public:
  Standing(const ContactLaw& law, double margin, std::size_t bodies)
      : law_(law), margin_(margin), pushed_(bodies), stopped_(bodies), passed_(bodies), known_(bodies) {}
  void next_frame();
  // A frame, or a part of it, of dt seconds.
  void begin(const world::World& world, double dt);

  // An impulse of this frame, N s: it cancels with others up to a part of its size. Bodies by their numbers in the world.
  void add(const lcp::Contact& contact, double impulse) {
    for (const int body : {contact.body_a, contact.body_b}) pushed_[at(body)] += impulse;
  }
  // After an instant: what is left of velocities that do not move the members.
  void stop(const world::World& world, std::span<Member> members);
  // The same of the paths of bodies that have got a plan; whether all of them stand.
  bool stop(world::World& world, const Planned& plan) const;

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
  double still_speed(const world::World& world, int body) const;

  const ContactLaw& law_;
  double margin_, dt_ = 0;
  std::vector<double> pushed_;   // N s, by all impulses of this frame on each body, their sizes added
  std::vector<double> stopped_;  // m/s, that was taken as rest in this frame
  std::vector<char> passed_;     // by a kinematic body, in this frame
  std::vector<Known> known_;
};

}  // namespace fc::resting

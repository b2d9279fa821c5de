// An island: bodies in contact with each other, directly or through others, at one instant.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ch05_resting_contact/contacts.hpp"
#include "ch05_resting_contact/path.hpp"

namespace fc::resting {

// Velocities of a body, m/s and rad/s.
struct Twist {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

// A body of an island, or a body that cannot be moved and that the island touches.
struct Member {
  int number = 0;        // in the world
  RigidBody state;       // at the instant
  bool dynamic = false;  // impulses can move it
};

// The contact at a point of two members (a and b are their places), at their poses in `bodies`; without restitution.
lcp::Contact contact_at(const world::World& world, std::span<const Member> members,
                        std::span<const RigidBody> bodies, int a, int b, const ContactPoint& point);

struct IslandPair {
  PairContacts* contacts;
  int a, b;  // places among the members
};

struct Island {
  std::vector<Member> members;    // in the order in which they were found
  std::vector<IslandPair> pairs;  // in contact
  int dynamic = 0;                // how many of the members can be moved
  int points() const {
    int count = 0;
    for (const IslandPair& pair : pairs) count += static_cast<int>(pair.contacts->points.size());
    return count;
  }
  // A bound of how many of its points can push at once: six for each pair of bodies.
  int rank() const {
    int count = 0;
    for (const IslandPair& pair : pairs) count += pair.contacts->rank();
    return count;
  }
};

// Finds islands. The bodies' states are those at the instant given to the last begin().
class IslandFinder {
 public:
  IslandFinder(Contacts& contacts, std::size_t bodies);
  void begin(double now);
  // The island of a body that can be moved and is in no island since begin(). A body without contacts is an island of
  // one, without pairs. Sleeping bodies that the island reaches belong to it. So do members of piles (pile_of[body] >=
  // 0), but the search stops there.
  Island grow(const world::World& world, int body, const std::vector<int>& pile_of);
  bool is_in_island(int body) const { return stamp_[at(body)] >= first_; }

 private:
  int place_of(const world::World& world, Island& island, int body);

  Contacts& contacts_;
  double now_ = 0;
  std::int64_t first_ = 1,
               island_ = 0;  // numbers of islands: the first since the last begin(), and the current one
  std::vector<std::int64_t> stamp_;  // of each body: its island's
  std::vector<int>
      place_;  // its place there; for a body that cannot be moved: its place in the current island, or -1
  std::vector<int> others_;
};

// Groups of bodies that are in contact, or may come into contact within dt seconds from a frame's start, and that would
// be too much work: event_work(arrivals, rank). Their boxes are in the schedule. `known`: groups that are known to be
// piles already.
std::vector<std::vector<int>> find_piles(const world::World& world, Contacts& contacts, double dt,
                                         double most_work,
                                         const std::function<double(double, int)>& event_work,
                                         const std::vector<std::vector<int>>& known);

}  // namespace fc::resting

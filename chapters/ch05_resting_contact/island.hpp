// An island: bodies in contact with each other, directly or over others, at one instant.
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

// A body of an island, or one that cannot be moved and that the island touches.
struct Member {
  int number = 0;        // in the world
  RigidBody state;       // at the instant
  bool dynamic = false;  // impulses can move it
};

// The contact at a point of two members (a and b are their places), as they stand in `bodies`; without restitution.
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
  // How many of them can push at once, at most: six of two bodies.
  int rank() const {
    int count = 0;
    for (const IslandPair& pair : pairs) count += pair.contacts->rank();
    return count;
  }
};

// Finds islands. Bodies' states are those at the instant that the last begin() named.
class IslandFinder {
 public:
  IslandFinder(Contacts& contacts, std::size_t bodies);
  void begin(double now);
  // The island of a body that can be moved and is in none since begin(). Bodies that are not in contact: an island of
  // one body without pairs. Sleeping bodies that it reaches belong to it. So do members of piles (pile_of[body] >= 0), but
  // the search does not go on from there.
  Island grow(const world::World& world, int body, const std::vector<int>& pile_of);
  bool is_in_island(int body) const { return stamp_[at(body)] >= first_; }

 private:
  int place_of(const world::World& world, Island& island, int body);

  Contacts& contacts_;
  double now_ = 0;
  std::int64_t first_ = 1, island_ = 0;  // numbers of islands: since the last begin(), and the one at hand
  std::vector<std::int64_t> stamp_;      // of each body: its island's
  std::vector<int> place_;  // there; of a body that cannot be moved, in the island at hand, or -1
  std::vector<int> others_;
};

// Groups of bodies that are in contact, or may come into contact with each other within dt seconds from a frame's start on,
// that would be too much work: event_work(arrivals, rank). Their boxes are in the schedule. `known`: groups of which this need not
// be found out.
std::vector<std::vector<int>> find_piles(const world::World& world, Contacts& contacts, double dt,
                                         double most_work,
                                         const std::function<double(double, int)>& event_work,
                                         const std::vector<std::vector<int>>& known);

}  // namespace fc::resting

// An island: bodies in contact with each other, directly or over others, at one instant.
#pragma once

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
  int number = 0;      // in the world
  RigidBody state;     // at the instant
  bool dynamic = false;  // impulses can move it
};

struct IslandPair {
  PairContacts* contacts;
  int a, b;  // places among the members
};

struct Island {
  std::vector<Member> members;    // in the order in which they were found
  std::vector<IslandPair> pairs;  // in contact
  int dynamic = 0;                // so many of the members can be moved
  int points() const {
    int count = 0;
    for (const IslandPair& pair : pairs) count += static_cast<int>(pair.contacts->points.size());
    return count;
  }
};

// Finds islands. Bodies' states are those at the instant that the last begin() named.
class IslandFinder {
 public:
  IslandFinder(Contacts& contacts, std::size_t bodies);
  void begin(double now);
  // The island of a body that can be moved and is in none since begin(). Bodies that are not in contact: an island of
  // one body without pairs. Sleeping bodies that it reaches belong to it.
  // Of bodies that `crowded` names, whoever may come into contact within `left` seconds belongs to it, too, and is then
  // crowded: one island, and no events in its midst.
  Island grow(const world::World& world, int body, std::vector<char>& crowded, double left);
  bool is_in_island(int body) const { return stamp_[static_cast<std::size_t>(body)] >= first_; }

 private:
  int place_of(const world::World& world, Island& island, int body);

  Contacts& contacts_;
  double now_ = 0;
  std::int64_t first_ = 1, island_ = 0;  // numbers of islands: since the last begin(), and the one at hand
  std::vector<std::int64_t> stamp_;       // of each body: its island's
  std::vector<int> place_;           // there; of a body that cannot be moved, in the island at hand, or -1
};

}  // namespace fc::resting

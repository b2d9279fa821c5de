// Islands: bodies that contacts join through bodies that impulses can move.
#pragma once

#include <vector>

#include "ch05_resting_contact/shell.hpp"

namespace fc::resting {

// Sets of bodies that grow together.
class Joined {
 public:
  explicit Joined(std::size_t bodies);
  int root(int body);
  void join(int a, int b) { parent_[static_cast<std::size_t>(root(a))] = root(b); }

 private:
  std::vector<int> parent_;  // a forest: two bodies of one tree are joined
};

// The contacts of each island by their places in the shell, ascending; only those that are `taken`.
std::vector<std::vector<int>> islands_of(const world::World& world, const std::vector<ShellContact>& shell,
                                         const std::vector<char>& taken);

// An island by itself: its bodies, and its contacts between them by their places here.
struct Island {
  std::vector<int> numbers;  // in the world
  std::vector<RigidBody> bodies;
  std::vector<lcp::Contact> contacts;

  // `states`: of all bodies. `place` is room for as many, all -1, and so again afterwards.
  Island(const std::vector<RigidBody>& states, const std::vector<ShellContact>& shell,
         const std::vector<int>& members, std::vector<int>& place);
};

}  // namespace fc::resting

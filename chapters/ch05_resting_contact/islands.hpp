// Islands: bodies that contacts join through bodies that impulses can move.
#pragma once

#include <vector>

#include "ch05_resting_contact/envelope.hpp"

namespace fc::resting {

// The contacts of each island by their places in the shell, ascending; only those that are `taken`.
std::vector<std::vector<int>> islands_of(const world::World& world, const std::vector<ShellContact>& shell,
                                         const std::vector<char>& taken);

// An island by itself: its bodies, and its contacts between them by their places here.
struct Island {
  std::vector<int> numbers;  // in the world
  std::vector<RigidBody> bodies;
  std::vector<double> reaches;  // m, of the bodies' shapes
  std::vector<lcp::Contact> contacts;

  // `place` is room for as many bodies as the world has, all -1, and so again afterwards.
  Island(const world::World& world, const std::vector<ShellContact>& shell, const std::vector<int>& members,
         std::vector<int>& place);
};

}  // namespace fc::resting

// Exercise 5.3: islands: which contacts have to be solved together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fc::exercises {

// Sets of the numbers 0 ... n - 1 that are joined step by step. Each is a tree: every number has a parent, and the
// root, which is its own parent, stands for the set.
struct Sets {
  std::vector<int> parents;
  std::vector<int> sizes;  // of each set, at its root
  std::int64_t steps =
      0;  // from a number to its parent, in all calls of find() together: the cost of searching
};

// n sets, each of one number.
Sets single_sets(int count);

// The root of the number's set. Shortens the path on its way: afterwards no number on it is farther from the root than
// before, and a number that was more than one step away is nearer.
int find(Sets& sets, int number);

// Makes one set of two; false if they were one already. The larger set's root remains the root, so that no path is ever
// longer than log2(n) steps.
bool join(Sets& sets, int a, int b);

// How many numbers are in the number's set.
int size(Sets& sets, int number);

struct Touch {
  int a = 0, b = 0;  // bodies, not equal
};

struct Island {
  std::vector<int> bodies;    // that move, ascending; none is in two islands
  std::vector<int> contacts;  // by their places in the list, ascending
  bool grounded = false;      // one of the contacts is with a fixed body
};

// The islands of bodies of which some are `fixed` (one entry each; not 0: static or kinematic). Two moving bodies that
// touch belong to one island, and so does every body that these touch. A fixed body takes no impulse and passes none
// on: it joins nothing and is in no island, though its contacts belong to the islands of the bodies that it touches. A
// contact of two fixed bodies belongs to no island, and neither does a body without contacts. Islands are in the order
// of their first contacts. The cost is that of a few steps for each contact.
std::vector<Island> islands_of(std::span<const char> fixed, std::span<const Touch> contacts);

}  // namespace fc::exercises

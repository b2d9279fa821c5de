// Exercise 5.3: islands: which contacts have to be solved together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fc::exercises {

// Sets of the numbers 0 ... n - 1 that grow together. Each is a tree: every number has a parent, and the
// root, which is its own, stands for the set.
class Sets {
 public:
  explicit Sets(int count);  // each number by itself
  // The root of the number's set. Shortens the path as it goes: no number that it passed is farther from the root
  // afterwards than before, and a number more than one step away is nearer.
  int find(int number);
  // Makes one set of two; false if they were one already. The larger set's root stays the root, so that no
  // path is ever longer than log2(n) steps.
  bool join(int a, int b);
  int size(int number);  // of its set
  // Steps from a number to its parent that find() has taken, of all calls together: what a search costs.
  std::int64_t steps() const { return steps_; }

 private:
  std::vector<int> parents_, sizes_;
  std::int64_t steps_ = 0;
};

struct Touch {
  int a = 0, b = 0;  // bodies, not equal
};

struct Island {
  std::vector<int> bodies;    // that move, ascending; none is in two islands
  std::vector<int> contacts;  // by their places in the list, ascending
  bool grounded = false;      // one of the contacts is with a fixed body
};

// The islands of bodies of which some are `fixed` (one entry each, not 0: static or kinematic). Two moving
// bodies that touch are of one island, and so is every body that these touch. A fixed body takes no impulse and
// passes none on: it joins nothing and is in no island, though its contacts are in the islands of
// the bodies that it touches. A contact of two fixed bodies is in none. A body without contacts is in none. Islands come in the order of
// their first contacts. The cost is that of a few steps for each contact.
std::vector<Island> islands_of(std::span<const char> fixed, std::span<const Touch> contacts);

}  // namespace fc::exercises

// Exercise 2.3: a time for each pair.
#pragma once

#include <functional>
#include <vector>

#include "ch01_convex_advancement/query.hpp"

namespace fc::exercises {

// The result of looking at a pair of nodes, at a time until which it is known to be clear.
struct Look {
  double clear_until = 0;     // s, not before that time: the new proof, for all pairs below this one. May be
                              // infinite
  bool reached = false;       // a pair of leaves whose gap is down to the target at that time
  std::vector<int> children;  // the pairs that replace it if it is opened; none: two leaves
};

// Two hierarchies as a search sees them: numbered pairs, and the look, the only thing that costs time.
struct Pairs {
  int root = 0;                                     // clear until 0
  std::function<Look(int pair, double time)> look;  // at any pair, at a time until which it is proved clear
};

struct Found {
  ca::Status status = ca::Status::unresolved;  // contact, separated or unresolved
  double time = 0;  // s. contact: when; unresolved: all pairs are clear until then; separated: the interval
  int pair = -1;    // contact: the leaves
};

// The first time in [0, interval) at which a pair of leaves has reached its target, and the pair.
//   most: the largest number of looks, >= 1; if they do not suffice, the answer is `unresolved`, with the
//   largest time until which all remaining pairs are proved clear.
// A pair is looked at exactly at the time until which it is proved clear, by its own looks and those of the
// pairs that it came from. A pair of nodes is looked at once, and then opened; a pair of leaves as often as
// it needs. No pair is looked at whose time lies beyond the first contact, or at the interval's end or later.
Found first_contact(const Pairs& pairs, double interval, int most);

}  // namespace fc::exercises

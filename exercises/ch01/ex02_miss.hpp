// Exercise 1.2: why did it miss?
#pragma once

#include <vector>

#include "ch01_convex_advancement/query.hpp"

namespace fc::exercises {

// A thin rod above the floor z = 0. Its middle rises or falls at a constant speed, and it turns at a constant
// rate in a vertical plane: at time t its middle is at height + climb t, and its angle with the floor is
// tilt + spin t.
struct Rod {
  double half_length = 0;  // m, > 0
  double height = 0;       // m
  double climb = 0;        // m/s, negative: falling
  double tilt = 0;         // rad
  double spin = 0;         // rad/s
};

struct Answer {
  ca::Status status = ca::Status::unresolved;  // contact, separated or unresolved
  double toc = 0;               // s: contact: when; unresolved: clear until then; separated: the interval
  std::vector<double> visited;  // s, each time that the advancement looked at, from 0 on
};

// The first contact of the rod with the floor in [0, interval] (s), by conservative advancement.
//   tolerance: m, > 0, and not so small that the rounding of a gap counts: at least 1e-13 of
//     height + half_length (1 + |tilt| + |spin| interval) + |climb| interval.
//   `contact` means: at toc the gap is positive and at most the tolerance.
//   most: the largest number of advances; if they do not suffice, the answer is `unresolved`.
// Guarantee: before toc the rod does not touch the floor. The rod starts above the floor, farther than the
// tolerance.
Answer first_contact(const Rod& rod, double interval, double tolerance, int most);

}  // namespace fc::exercises

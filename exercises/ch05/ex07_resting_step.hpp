// Exercise 5.7: the heart of a resting step. A piece of the engine: chapter 5's program runs on it with --mine.
#pragma once

#include "ch05_resting_contact/clear/resting_step.hpp"

namespace fc::mine {

using resting::clear::LcpFunction;
using resting::clear::RestingProblem;
using resting::clear::RestingResult;
using resting::clear::RestingRow;

// One plan of T = island.length seconds, for the bodies of one island. With g the gaps of its rows (contact.gap), and
// r = island.rest_gap:
//
//   1. half of gravity  u = v + T/2 * gravity, for the velocities of all bodies (spins stay)
//   2. push             w = u + M^-1 J'z. Each contact may close with at most
//                           max((g + bend - keep) / T, -end_speed)   m/s,   keep = min(g, r)
//                       (negative: it has to part), z >= 0, and z acts only where the contact closes with just that.
//   3. correct          y = w + M^-1 J'c, the same with at most
//                           (g + bend - want) / T   m/s,             want = max(keep + (r - keep) / 5, r / 2)
//
// Returns z and c (N s, one for each row), and the bodies at their present poses, once with the velocities w, once with
// y. The bodies of `island` are not changed. solve_lcp finds the impulses: it gets A (n by n) and b (n), and finds z.
// If it fails, it leaves z unchanged.
//   2 has no solution: `solved` is false, and the rest of the result is meaningless.
//   3 has no solution: there is no room to correct the gaps; c is 0, and y is w. `solved` stays true.
//   No rows: solved; w and y are u.
// Of chapter 3 you may use, in namespace lcp,
//   assemble(bodies, contacts)             A, and v_before = J v        ch03_impulse_lcp/delassus.hpp
//   apply_impulse(bodies, contact, N s)    gives it to the two bodies   ch03_impulse_lcp/impact.hpp
RestingResult resting_step(const RestingProblem& island, const LcpFunction& solve_lcp);

}  // namespace fc::mine

// The heart of a resting step, for one island: from the gaps of its contacts to the velocities and the paths of its bodies.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "ch03_impulse_lcp/contact.hpp"

namespace fc::resting::clear {

// Solves chapter 3's problem: finds z >= 0 with A z + b >= 0 and z'(A z + b) = 0. Returns false, and leaves z as it
// was, if it finds none.
using LcpFunction = std::function<bool(const MatX& A, const VecX& b, VecX& z)>;

// A contact point of the island, and what is known of it at the plan's end.
struct RestingRow {
  lcp::Contact contact;  // bodies by their places in RestingProblem::bodies; contact.gap (m) is the gap now
  double bend = 0;       // m: the gap at the end is  gap + T (velocity of the contact on the path) + bend
  // m/s, >= 0: how fast the contact closes at the plan's end; infinite as long as this is unknown
  double end_speed = std::numeric_limits<double>::infinity();
};

// One island at an instant, and the plan's length.
struct RestingProblem {
  std::vector<RigidBody> bodies;  // where they are, with their velocities v; including static ones
  std::vector<Vec3> gravity;      // m/s^2, of each body; zero for bodies that gravity does not move
  std::vector<RestingRow> rows;
  double length = 0;    // s, T > 0
  double rest_gap = 0;  // m, h/2 > 0
};

struct RestingResult {
  bool solved = false;  // false: no impulses keep the gaps open, and the rest of the result is meaningless
  VecX z, c;            // N s, of each row: the impulses, and those of the correction
  std::vector<RigidBody> w,
      y;  // the bodies where they are now: with their new velocities, and with those of their paths
};

// The function of exercise 5.7. A body moves by T times its velocity in y; the other half of gravity comes later.
using RestingStepFunction = RestingResult(const RestingProblem& island, const LcpFunction& solve_lcp);
RestingStepFunction resting_step;

// Gives the bodies impulses z >= 0 after which contact i closes with at most spare_i (m/s), and which act only where it
// closes with exactly that. Returns false if there are none: then the velocities stay, and z is 0.
bool push(std::vector<RigidBody>& bodies, std::span<const lcp::Contact> contacts, const VecX& spare,
          const LcpFunction& solve_lcp, VecX& z);

}  // namespace fc::resting::clear

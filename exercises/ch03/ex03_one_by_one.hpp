// Exercise 3.3: one contact after the other.
#pragma once

#include <span>

#include "ch03_impulse_lcp/contact.hpp"
#include "ch03_impulse_lcp/problem.hpp"

namespace fc::exercises {

enum class Choice {
  in_turn,  // contacts 0, 1, ..., n - 1, and again from 0 on; those that do not approach are skipped
  fastest,  // always the one that approaches fastest; of equals, the one with the smallest index
};

struct Sequence {
  lcp::Status status = lcp::Status::limit;  // solved or limit
  int hits = 0;                             // impulses that were applied
};

// Resolves an impact as a chain of hits. A hit serves one contact that approaches, as if it were alone, with
// the velocities that all hits before it have left: an impulse j along its normal, at its point, after which
// its velocity is -epsilon times what it was just before that hit. Bodies of infinite mass do not change, and
// a contact of two of them is skipped, as if it did not approach: no impulse can help it.
//   slowest: m/s, > 0: a contact counts as approaching if its velocity is < -slowest.
//   most: the largest number of hits, >= 0.
// `solved`: no contact approaches any more. `limit`: some still do after `most` hits; the bodies then have
// the velocities that those hits have left. Contacts are as for lcp::assemble().
Sequence resolve_one_by_one(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                            Choice choice, double slowest, int most);

}  // namespace fc::exercises

// One contact with friction, exactly, in its clear form. one_contact.hpp is the fast one.
#pragma once

#include "common/types.hpp"

namespace fc::friction::clear {

// What a contact does at one instant.
enum class Kind { open, stick, slip };

struct Answer {
  Kind kind = Kind::open;
  Vec3 r = Vec3::Zero();  // N s: along the normal, and along two tangents
};

// Signorini's and Coulomb's laws for u = A r + q, the velocity after the impulse. Of several right answers: open before
// stick before slip, and of several slips the slowest. A contact that closes in where no impulse helps (A is zero) is
// open, too.
//   A: 3 by 3, 1/kg, symmetric, positive semidefinite; rows (normal, two tangents).
//   q: m/s, the velocity without this contact's impulse.  mu: >= 0.
// Guarantee: the law is violated by at most 1e-12 of (|A||r| + |q|)_max. Limit: if there are three slips, two of them
// may both be missed if their values of α/(α + tr D̂) differ by less than 0.02.
// Throws std::invalid_argument if mu < 0, or if any number is not finite.
using ContactFunction = Answer(const Mat3& A, const Vec3& q, double mu);
ContactFunction solve_contact;

}  // namespace fc::friction::clear

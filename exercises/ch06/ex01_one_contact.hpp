// Exercise 6.1: one contact with friction, exactly.
#pragma once

#include "ch06_friction/clear/one_contact.hpp"

namespace fc::mine {

using friction::clear::Answer;  // r, N s: along the normal and two tangents; and which kind of answer it is
using friction::clear::Kind;    // open, stick or slip

// One contact that obeys Signorini and Coulomb. Vectors are (normal, tangent 1, tangent 2): three directions at right angles.
//   A    1/kg, symmetric, positive semidefinite: an impulse r changes the velocity at the contact by A r. A direction of the
//        tangent plane may be dead: nothing moves along it, whatever the impulse.
//   q    m/s: the velocity without the impulse. A negative q_N closes in.
//   mu   >= 0: the coefficient of friction.
//
// With the answer r the velocity is u = A r + q, and one of these is true.
//   open    r = 0, and u_N >= 0.
//   stick   u = 0, and |r_T| <= mu r_N. Along a dead direction: no velocity, and no impulse.
//   slip    u_N = 0, |r_T| = mu r_N, and r_T = -s u_T with an s >= 0: friction is against the slip *after* the impulse.
// Where several are true (Painlevé's rod), open goes before stick, and stick before slip. Of several slips the answer
// is the slowest; but a pair of slips may be missed if their values of α/(α + tr D̂) differ by less than 0.02 (α, D̂:
// see the statement). A contact that closes in where no impulse helps (A is zero) is open, too, with r = 0.
//
// Promised: these conditions are violated by at most 1e-12 of the sizes that are added up, (|A||r| + |q|)_max, even
// where entries of A differ by a factor of 1e8, and for any mu. The answer does not depend on which orthogonal tangents
// describe the problem. Throws std::invalid_argument if mu < 0, or if any number is not finite.
Answer solve_contact(const Mat3& A, const Vec3& q, double mu);

}  // namespace fc::mine

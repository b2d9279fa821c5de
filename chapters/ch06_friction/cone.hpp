// Coulomb's cone, and the step that measures how far a contact is from its law.
//
// A contact's vectors are (normal, tangent 1, tangent 2). With µ the friction coefficient,
//     K  = {r : |r_T| <= µ r_N}      impulses that friction allows,
//     K* = {x : x_N >= µ |x_T|}      its dual: x·r >= 0 for every r in K.
// Signorini's condition and Coulomb's law together are one line, K* ∋ û ⟂ r ∈ K, where û = (u_N + µ|u_T|, u_T) is the
// velocity afterwards, shifted as by De Saxcé and Feng (1991; Acary and Brogliato 2008, section 3.9).
#pragma once

#include "common/types.hpp"

namespace fc::friction {

// The point of K nearest to x, in any unit. mu: >= 0.
Vec3 project_onto_cone(const Vec3& x, double mu);

// û = (u_N + µ|u_T|, u_T), m/s.
Vec3 de_saxce(const Vec3& u, double mu);

// How far the impulse and velocity of one contact are from its law, m/s: scale |r - P_K(r - û/scale)|, the length of
// one projected step. It is 0 exactly if K* ∋ û ⟂ r ∈ K.
//   r: N s;  u: m/s, the velocity after;  scale: 1/kg, > 0, what turns impulses into velocities.
double cone_violation(const Vec3& r, const Vec3& u, double mu, double scale);

}  // namespace fc::friction

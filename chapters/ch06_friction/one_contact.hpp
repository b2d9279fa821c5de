// One contact, exactly. Its three rows have a solution in closed form except for one number, which a bracketed root
// finder gives. Gauss-Seidel calls this for every contact in every sweep.
//
//     u = A r + q,   A = | a  c' |,   q = (β, d),   K* ∋ û ⟂ r ∈ K   (cone.hpp)
//                        | c  D  |
//
//   open    β >= 0:                      r = 0.
//   stick   r = -A⁻¹ q inside the cone:  u = 0.
//   slip    u_N = 0 and u_T = -α r_T for an α > 0. Eliminating r_N leaves D̂ = D - cc'/a, d̂ = d - cβ/a, and
//             r_T(α) = -(D̂ + α I)⁻¹ d̂,  r_N(α) = -(β + c·r_T)/a,  f(α) = |r_T| - µ r_N = 0.
//           f(0) > 0, or it would stick, and f(∞) = µβ/a < 0: for any µ there is a root.
//
// There may be several answers: Painlevé's rod has three. The order of preference is open, stick, least slip. |u_T| = α
// |r_T| grows with α, so the least slip is the least root. There is only one root, and none beside stick, if µ |c|/a <=
// 2 √(δ₁δ₂)/(δ₁ + δ₂), δ the eigenvalues of D̂: then f falls everywhere (by Kantorovich's inequality).
#pragma once

#include "common/types.hpp"

namespace fc::friction {

using Vec2 = Eigen::Vector2d;

class OneContact {
 public:
  // Factors the block once: its tangents are turned into the eigenvectors of D̂.
  //   A: 3 by 3, symmetric, positive semidefinite, 1/kg; rows (normal, two tangents). Directions in which no
  //   impulse moves anything are allowed.
  //   mu: >= 0, finite.
  OneContact(const Mat3& A, double mu);

  // r, N s, for the velocity q (m/s) without this contact's impulse. No heap allocation. Guarantee: r is in K, |r_T| <=
  // µ r_N to the last digits. Where a = 0 no impulse helps: then r = 0.
  Vec3 solve(const Vec3& q) const;

 private:
  double mu_, a_;
  Vec2 c_;         // c/a in D̂'s eigenbasis
  Vec2 delta_;     // 1/kg, D̂'s eigenvalues, ascending; 0 for a direction in which nothing moves
  Vec2 axis_;      // the first eigenvector; the second is perpendicular to it
  double size_;    // 1/kg, A's largest entry
  bool one_root_;  // the inequality above holds
};

}  // namespace fc::friction

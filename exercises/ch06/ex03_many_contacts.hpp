// Exercise 6.3: many contacts, one after the other, and the number that says when the answer is good enough.
#pragma once

#include <cmath>

#include "common/types.hpp"

namespace fc::exercises {

// n contacts; each has three rows: normal, tangent, tangent. Impulses r (N s) make the velocities u = A r + b (m/s).
struct Problem {
  MatX A;   // 3n by 3n, 1/kg, symmetric, positive semidefinite; no normal row is zero
  VecX b;   // 3n
  VecX mu;  // n, >= 0
};

struct Result {
  VecX r;
  double residual = 0;    // of r, see residual()
  int sweeps = 0;         // sweeps made
  double relaxation = 1;  // ω at the end
  bool solved = false;    // residual <= tolerance
};

// How far r is from the law, without units. With û = (u_N + mu |u_T|, u_T), P the nearest point of the cone |r_T| <= mu r_N, and
// s the largest entry (absolute) of a contact's 3 by 3 block of A:
//
//     largest over contacts of  s |r - P(r - û/s)|,  divided by the larger one of |b|_max and (|A| |r|)_max
//
// It is 0 exactly for solutions, and does not depend on units, masses or the length of a frame. 0 if all velocities are
// 0.
double residual(const Problem& problem, const VecX& r);

// Sweeps from r = 0: through the contacts forwards, then backwards, and so on by turns. At each contact
//     r := (1 - ω) r + ω one_contact(its block of A, its velocities without its own impulse, mu)
// with all other impulses as they are now. At first ω = 1. After every 50 sweeps: if the smallest residual of these 50
// is not below 0.95 times the smallest one before, the sweeps go in circles, and ω is halved; but never below 1/16.
// Ends as soon as the residual is at most the tolerance (checked before the first sweep and after each), or after
// `most` sweeps (>= 0).
Result solve(const Problem& problem, double tolerance, int most);

// The heat of friction, J: the sum of -r_T·u_T. For a solution this is mu r_N |u_T| of each contact, and the impulses
// change the energy by ½ r·(u + b) = -½ r·A r - heat.
double heat(const Problem& problem, const VecX& r);

// Given: the impulse of one contact (exercise 6.1), for invertible blocks.
inline Vec3 one_contact(const Mat3& A, const Vec3& q, double mu) {
  using Vec2 = Eigen::Vector2d;
  using Mat2 = Eigen::Matrix2d;
  if (q[0] >= 0) return Vec3::Zero();
  const Vec2 c = A.block<2, 1>(1, 0) / A(0, 0), d = q.tail<2>() - c * q[0];
  const Mat2 D = A.block<2, 2>(1, 1) - A(0, 0) * c * c.transpose();
  const auto answer = [&](double alpha) {
    const Mat2 M = D + alpha * Mat2::Identity();
    const Vec2 r = Vec2(M(0, 1) * d[1] - M(1, 1) * d[0], M(1, 0) * d[0] - M(0, 0) * d[1]) / M.determinant();
    return Vec3(-q[0] / A(0, 0) - c.dot(r), r[0], r[1]);
  };
  const auto excess = [&](double alpha) {
    const Vec3 r = answer(alpha);
    return r.tail<2>().norm() - mu * r[0];
  };
  if (mu == 0) return {-q[0] / A(0, 0), 0, 0};
  if (excess(0) <= 0) return answer(0);
  double low = 0, high = 2 * d.norm() * (1 + mu * c.norm()) * A(0, 0) / (-mu * q[0]);
  for (int k = 0; k < 200 && low + 0.5 * (high - low) < high; ++k) {
    const double middle = low + 0.5 * (high - low);
    if (middle == low) break;
    (excess(middle) > 0 ? low : high) = middle;
  }
  Vec3 r = answer(high);
  if (const double size = r.tail<2>().norm(); size > 0) r.tail<2>() *= mu * r[0] / size;
  return r;
}

}  // namespace fc::exercises

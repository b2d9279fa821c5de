// Exercise 3.1: two contacts, case by case.
#pragma once

#include <vector>

#include "common/types.hpp"

namespace fc::exercises {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

// One solution of w = A z + b, z >= 0, w >= 0, z_i w_i = 0. For contacts z are impulses in N s, w velocities
// in m/s, and A is in 1/kg.
struct Answer {
  Vec2 z;  // exactly 0 for a contact that does not push
  Vec2 w;  // exactly 0 for a contact that pushes
};

// All solutions whose pushing contacts P = {i: z_i > 0} have an invertible block A_PP; each once, in any
// order. (With a singular block, solutions form whole lines; only their ends are wanted.) If A is symmetric
// and positive semidefinite, an empty list proves that there is no solution at all.
//   A: any 2 by 2 matrix; it may be singular, zero, or neither symmetric nor semidefinite.
//   b: any.
// Guarantee: where the entries of A and b are whole numbers up to 2^24, no solution is lost to rounding, none
// is invented, and each number of an answer is the exact one, rounded once.
std::vector<Answer> solve_two(const Mat2& A, const Vec2& b);

}  // namespace fc::exercises

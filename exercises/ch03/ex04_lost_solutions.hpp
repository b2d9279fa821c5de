// Exercise 3.4: who lost the solution?
#pragma once

#include "ch03_impulse_lcp/problem.hpp"

namespace fc::exercises {

struct Driven {
  lcp::Status status = lcp::Status::limit;  // solved, no_solution or limit
  VecX z;                                   // n, the impulses in N s; an answer only if solved
  VecX certificate;                         // n, if no_solution: y >= 0, A y = 0, b'y < 0; else empty
  int pivots = 0;                           // rows that entered or left the basis
};

// Solves w = A z + b, z >= 0, w >= 0, z'w = 0 by Dantzig's method, row after row, as in the chapter's text.
//   A: n by n, 1/kg, symmetric, positive semidefinite, of any rank; a common factor of all entries, 2^-40 or
//      2^40, must not matter
//   b: n, m/s; nor must a factor of b
//   most: the largest number of pivots
// If n <= 16, if the entries are 0 or within about 1e3 of each other, and if no problem is nearly singular
// (with small whole numbers, for example), no solution is lost, and none is invented. `solved`:
// lcp::acceptable(); `no_solution`: lcp::certifies_no_solution(); `limit`: after `most` pivots it is not
// known.
Driven drive_all(const MatX& A, const VecX& b, int most);

}  // namespace fc::exercises

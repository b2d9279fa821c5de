// Exercise 3.2: gradients with momentum, for a matrix that is never formed.
#pragma once

#include <span>

#include "ch03_impulse_lcp/delassus.hpp"

namespace fc::exercises {

// The Delassus matrix as this exercise may use it: only by products, which are counted.
class Products {
 public:
  Products(std::span<const RigidBody> bodies, std::span<const lcp::Contact> contacts)
      : operator_(bodies, contacts) {}

  Eigen::Index size() const { return operator_.size(); }  // n
  // A z, n, in m/s for z in N s.
  VecX times(const VecX& z) {
    ++spent_;
    VecX v;
    operator_.apply(z, v);
    return v;
  }
  int spent() const { return spent_; }  // products so far

 private:
  lcp::DelassusOperator operator_;
  int spent_ = 0;
};

// The largest eigenvalue of A, 1/kg, approximated from below: at most the true one (up to 1e-12 of it), and
// at least 0.98 of it for 1 to 200 contacts. 0 if A is 0, and if there are no contacts.
//   products: the largest number of products with A that may be spent; for the 0.98, 400.
double largest_eigenvalue(Products& A, int products);

// Impulses z >= 0 that nearly solve w = A z + b, z >= 0, w >= 0, z'w = 0, by projected gradients with
// momentum. An impact of n balls in a row, for n up to 100, is solved to within 1e-6 max|b| after 1000
// products, in the sense that |min(A_ii z_i, w_i)| is no larger for any row.
//   b: n, m/s.   largest: 1/kg, > 0, up to 2 % below the largest eigenvalue.
//   products: the largest number of products with A that may be spent, >= 1.
VecX momentum_gradients(Products& A, const VecX& b, double largest, int products);

// ---- Given: the same without momentum. ----

// z <- max(0, z - (A z + b) / L), from 0 on: downhill in the energy 1/2 z'Az + b'z, by the longest step that
// A's largest eigenvalue L allows.
inline VecX plain_gradients(Products& A, const VecX& b, double largest, int products) {
  VecX z = VecX::Zero(b.size());
  for (int k = 0; k < products; ++k) z = (z - (A.times(z) + b) / largest).cwiseMax(0.0);
  return z;
}

}  // namespace fc::exercises

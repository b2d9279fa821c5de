// The linear complementarity problem (LCP), a solver's result, and the check of the one against the other.
//
//     w = A z + b,   z >= 0,   w >= 0,   z_i w_i = 0 for every row i
//
// For impacts z are impulses (N s), w velocities (m/s) and A the Delassus matrix (1/kg), but nothing here
// depends on that.
#pragma once

#include <limits>
#include <ostream>

#include "common/types.hpp"

namespace fc::lcp {

enum class Status {
  solved,       // z passed acceptable()
  no_solution,  // proved: a certificate y >= 0, A'y <= 0, b'y < 0 was found and checked
  ray,          // the method ended on a ray to infinity (Lemke's method; never Dantzig's)
  limit,        // the pivot limit was reached, or the result, by round-off, did not pass acceptable()
  unsuited,     // the matrix is not one that the method is made for
};

// "solved", "no_solution", "ray", "limit", "unsuited": the words of solvers.csv.
const char* name(Status status);
inline std::ostream& operator<<(std::ostream& out, Status status) {
  return out << name(status);
}

// A problem as a solver takes it. It holds references: both must outlive the solve. Bounds are for friction
// and joints; ordinary contacts need none. Where they are given, lower <= z <= upper takes the place of z >=
// 0, and
//     w_i >= 0 where z_i = lower_i,   w_i <= 0 where z_i = upper_i,   w_i = 0 between them.
struct Lcp {
  const MatX& A;                // n by n
  const VecX& b;                // n
  const VecX* lower = nullptr;  // n, in [-infinity, 0]; null: 0
  const VecX* upper = nullptr;  // n, in [0, infinity], upper_i > lower_i; null: infinity

  Eigen::Index size() const { return b.size(); }
  bool boxed() const { return lower != nullptr || upper != nullptr; }
  double low(Eigen::Index i) const { return lower != nullptr ? (*lower)[i] : 0.0; }
  double high(Eigen::Index i) const {
    return upper != nullptr ? (*upper)[i] : std::numeric_limits<double>::infinity();
  }
};

// What every solver returns. Unless solved, z and w are those at which the method stopped: finite, but not an
// answer.
struct LcpResult {
  Status status = Status::limit;
  VecX z;                 // n
  VecX w;                 // n, always A z + b, computed anew from z
  double residual = 0;    // of (z, w), see residual()
  int pivots = 0;         // exchanges of a row between the sets "z >= 0, w = 0" and "z = 0, w >= 0"; for an
                          // iterative method its sweeps, for Newton's its steps
  VecX certificate = {};  // n, y of no_solution_certificate(), if the status is no_solution; else empty
};

// Throws std::invalid_argument unless A is n by n, b is n long, all their entries are finite, and the bounds
// are as Lcp says.
void check_arguments(const Lcp& problem);

// w = A z + b, each row summed in extended precision and rounded once.
VecX evaluate(const MatX& A, const VecX& b, const VecX& z);

// How far (z, w) is from complementarity, without a unit: max_i |min(s_i z_i, w_i)| / max(|b|, ||A||z||),
// norms of the largest entry, s_i = max_j |A_ij|; 0 where numerator and denominator are 0. Multiplying A, b
// or z by a positive number changes nothing. With bounds, the middle one of s_i (z_i - lower_i), w_i and s_i
// (z_i - upper_i) takes the place of min(s_i z_i, w_i). z and w: n. A NaN anywhere gives NaN.
double residual(const Lcp& problem, const VecX& z, const VecX& w);

// Whether (z, w) may be called solved. True only if
//   z keeps its bounds exactly, and is at the one that w_i asks for where s_i = 0;
//   w is A z + b to within r = 8 n epsilon max_i (|A||z|)_i, the round-off of a sum of n products;
//   max_i |min(s_i z_i, w_i)| (or its form with bounds) <= 1e-6 max|b| + r, and r <= 1e-3 max|b|: a huge z
//   would make any residual small, because z is in its denominator, while w loses every digit.
// Guarantee: what fails this is never called solved. Limit: it bounds an error in velocities, not in
// impulses, which need not be unique.
bool acceptable(const Lcp& problem, const VecX& z, const VecX& w);

// Whether y, n, proves that a problem has no solution: every solution would have y'w >= 0, but y'w = (A'y)'z
// + b'y is negative for every z that the bounds allow. That is so if b'y < 0 and A'y <= 0, y being >= 0; with
// bounds other than z >= 0, if A'y = 0, and y has entries only in directions in which a row has no bound.
// Checked by multiplication. Round-off keeps A'y from being exactly 0, so the claim is: a solution would need
// impulses more than 1e8 times those that b needs in single rows. And b'y must be below -1e-9 |b|'y, or it
// may be round-off in b. Entries of y of the wrong sign count as 0.
bool certifies_no_solution(const Lcp& problem, const VecX& y);
// The same y without its entries of the wrong sign, and of size 1 in rows scaled to a diagonal of 1: anyone can
// check it by multiplication. Empty if it certifies nothing.
VecX no_solution_certificate(const Lcp& problem, const VecX& y);

// A solver's last check: residual() and acceptable() at once, without allocation after the first problem of a
// size.
struct Verdict {
  double residual = 0;
  double error = 0;  // the same violation relative to max|b|: the relative error of v+
  bool acceptable = false;
};
class Verifier {
 public:
  // Sets w = A z + b, in extended precision where digits cancel, and judges (z, w). Sizes must match.
  Verdict judge(const Lcp& problem, const VecX& z, VecX& w);

 private:
  friend double residual(const Lcp&, const VecX&, const VecX&);
  friend bool acceptable(const Lcp&, const VecX&, const VecX&);
  // The terms of the residual.
  struct Measures {
    double violation = 0;  // max_i |min(s_i z_i, w_i)|, or its form with bounds
    double b_size = 0;     // max_i |b_i|
    double az_size = 0;    // max_i (|A||z|)_i
    bool in_bounds = true;
  };
  void sum_rows(const Lcp& problem, const VecX& z);
  Measures measure(const Lcp& problem, const VecX& z, const VecX& w) const;

  VecX scale_, products_, w_;  // s_i, (|A||z|)_i, (A z + b)_i
};

}  // namespace fc::lcp

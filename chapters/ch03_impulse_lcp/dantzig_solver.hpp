// Dantzig's method from the inside: one solve, its state and its steps. Users include dantzig.hpp.
#pragma once

#include <limits>
#include <vector>

#include "ch03_impulse_lcp/basis_factor.hpp"
#include "ch03_impulse_lcp/problem.hpp"

namespace fc::lcp::detail {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// All tolerances of this solver are ratios: rows are scaled so that the diagonal of A lies in [1/2, 2]. These
// two, in units of epsilon, times sqrt(n + 16) and n + 4: round-off grows with the root of the terms of a sum
// where their signs are random, and with their number at worst. The first decides what counts as zero among
// z, w and slopes, so it bounds the residual; the second decides which rows count as dependent, where a worst
// case costs a whole answer.
constexpr double kRoundingUnits = 4;
constexpr double kRankUnits = 16;

// How one attempt decides what is nearly dependent, and in which order it takes the rows (see kAttempts).
struct Attempt {
  double rank_factor;  // the threshold, in units of its smallest sensible value
  bool reversed;       // rows from the last to the first
};

enum class Place : char { waiting, basis, outside };  // outside: done, z = 0 and w >= 0
enum class Drive { done, no_solution, limit, unsuited };

class Dantzig {
 public:
  Dantzig(const MatX& A, const VecX& b, const Attempt& attempt, int max_pivots);
  LcpResult run();

 private:
  struct Blocking {
    int row = -1;       // -1: nothing blocks
    int position = -1;  // in the basis; -1 if outside
    double step = kInfinity;
  };

  Drive drive(int d);
  void set_direction(int d);
  Blocking blocking_row(int d, double schur);
  void advance(int d, double step);
  void settle(int d);
  void enter(int i);
  void leave(int position);
  bool proves_infeasible(int d) const;
  void solve_basis();
  bool drop_negative();
  bool symmetric() const;
  LcpResult finish(Status status);
  // Round-off of w_i; and the z below zero whose removal changes no w by more than round-off.
  double w_tolerance(int i) const { return rounding_ * (b_size_ / scale_[i] + z_.lpNorm<1>()); }
  double z_tolerance() const { return rounding_ * (b_size_ / largest_scale_ + z_.lpNorm<1>()); }

  const MatX& A_given_;
  const VecX& b_given_;
  VecX scale_;  // powers of two, about sqrt(A_ii): exact
  MatX A_;      // A_ij / (scale_i scale_j), symmetric
  VecX b_;      // b_i / scale_i
  double b_size_, largest_scale_;
  double rounding_;       // what a sum of n products may lose, as a ratio
  double rank_rounding_;  // a Schur complement below this is zero
  BasisFactor factor_;
  VecX z_, w_;     // scaled: z_i scale_i, w_i / scale_i
  VecX dz_, dw_;   // the direction in which row d is driven
  VecX basis_dz_;  // dz of the basis, in its order
  std::vector<Place> place_;
  std::vector<char> barred_;  // rows outside that blocked, but depend on the basis: no exchange can help
  int pivots_ = 0, max_pivots_;
  bool reversed_;
  int zero_steps_ = 0;  // in a row: degenerate pivots
  double lowest_schur_ = 0;
};

}  // namespace fc::lcp::detail

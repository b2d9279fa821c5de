// The inside of Dantzig's method: one attempt at one problem, its state and its steps. Users include
// dantzig.hpp.
#pragma once

#include <limits>
#include <vector>

#include "ch03_impulse_lcp/basis_factor.hpp"
#include "ch03_impulse_lcp/problem.hpp"

namespace fc::lcp::detail {

// All tolerances of this solver are ratios: rows are scaled so that the diagonal of A lies in [1/2, 2]. These
// two are in units of epsilon, times sqrt(n + 16) and n + 4: round-off grows with the root of the number of
// terms where their signs are random, and with that number at worst. The first decides what counts as zero
// among z, w and slopes, so it bounds the residual. The second decides which rows count as dependent; there a
// worst case costs the whole answer.
constexpr double kRoundingUnits = 4;
constexpr double kRankUnits = 16;

// How one attempt decides what is nearly dependent, where it begins and in which order it takes the rows.
struct Attempt {
  double rank_factor = 1;  // the threshold, in units of its smallest sensible value
  bool predict = true;     // begin with a predicted basis, factored at once
  bool reversed = false;   // rows from the last to the first
};

// at_lower, at_upper: done, z at this bound, and w such that it stays there.
enum class Place : char { waiting, basis, at_lower, at_upper };
enum class Drive { done, no_solution, limit, unsuited };

// Real: the arithmetic of the factor and of the drives; double, or, where double cannot tell dependent rows
// from independent ones, long double.
template <class Real>
class DantzigCore {
 public:
  // Scales and copies the problem, which must live until the last solve(). False if single rows show that the
  // matrix is outside the method's class.
  bool load(const Lcp& problem);

  // start: a guess of z, or null. Returns `solved` if all rows are complementary, by the method's own values.
  Status solve(const Attempt& attempt, const VecX* start, int max_pivots);
  // n; within the bounds exactly.
  void impulses(VecX& z) const;
  const VecX& certificate() const { return certificate_; }  // of the last solve, if it ended with no_solution
  // Solves the basis again, and drives the rows that round-off has left violated, until there are none.
  Status improve();
  // One step of iterative refinement of the basis: its residual w is computed from the matrix as given, in
  // extended precision. Returns whether everything stayed within its bounds: only then does the claim of
  // solve() still hold.
  bool refine();
  int pivots() const { return pivots_; }
  // Exchanges since z was last found from the factor, not by steps.
  int steps_since_solved() const { return pivots_ - pivots_solved_; }
  bool indefinite() const { return lowest_schur_ < -rank_rounding_; }

 private:
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  static constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();
  static constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

  // What stops a drive.
  struct Blocking {
    int row = -1;       // -1: nothing
    int position = -1;  // in the basis; -1 if outside
    Real step = kInfinity;
    bool at_bound = false;  // the driven row itself: its z has reached a bound, not its w zero
  };

  void reserve(int n);
  bool load_matrix();
  void symmetrise(int first_row, int rows, int first_column, int columns);
  Status drive_rows(bool reversed, bool& changed);
  // dantzig_drive.cpp
  Drive drive(int d);
  void set_direction(int d, Real sign);
  Blocking blocking_row(int d, Real schur);
  template <class Visit>
  void each_candidate(Visit&& visit) const;
  void advance(int d, Real step);
  void settle(int d);
  void enter(int i);
  void leave(int position, bool upper);
  bool proves_infeasible(int d);
  // dantzig_predict.cpp
  bool guess(const VecX* start);
  void predict();
  int factor_basis();
  void replace_violated();
  int violations() const;
  void exchange_violated();
  void drop_violated();
  // dantzig_core.cpp
  void solve_basis();
  void set_w();
  Real w_of(int i) const;
  bool within_bounds(int i, Real slack) const {
    return z_[i] >= lower_[i] - slack && z_[i] <= upper_[i] + slack;
  }
  bool violated(int i) const {
    const Real slack = w_tolerance(i);
    return (w_[i] < -slack && z_[i] < upper_[i]) || (w_[i] > slack && z_[i] > lower_[i]);
  }
  // Round-off of w_i; and the z beyond a bound whose removal changes no w by more than round-off.
  Real w_tolerance(int i) const { return rounding_ * (b_size_ * inverse_scale_[i] + z_sum_); }
  Real z_tolerance() const { return rounding_ * (b_size_ / largest_scale_ + z_sum_); }
  Place& place(int i) { return place_[static_cast<std::size_t>(i)]; }
  Place place(int i) const { return place_[static_cast<std::size_t>(i)]; }
  auto extent(const Vector& v) const { return v.segment(first_, extent_); }
  auto extent(Vector& v) { return v.segment(first_, extent_); }

  const Lcp* problem_ = nullptr;
  int n_ = 0, capacity_ = 0;
  bool symmetric_ = true;
  Vector scale_, inverse_scale_;  // powers of two, about sqrt(A_ii): exact
  Matrix A_, transposed_;         // A_ij / (scale_i scale_j); the second only where A is not symmetric
  Vector b_, lower_, upper_;      // b_i / scale_i, bounds times scale_i
  Real b_size_ = 0, largest_scale_ = 1;
  Real rounding_ = 0;       // what a sum of n products may lose, as a ratio
  Real rank_rounding_ = 0;  // a Schur complement below this is zero
  BasisFactor<Real> factor_;
  Vector z_, w_;    // scaled: z_i scale_i, w_i / scale_i; w only of rows that are done
  Real z_sum_ = 0;  // sum |z_i|
  Vector dz_, dw_;  // the direction in which row d is driven
  Real dz_sum_ = 0;
  Vector basis_;  // numbers for each row of the basis, in its order
  std::vector<Place> place_;
  std::vector<int> outside_;  // the rows at a bound
  std::vector<char> barred_;  // rows outside that blocked, but depend on the basis: no exchange can help
  std::vector<int> wanted_;
  int first_ = 0, extent_ = 0;  // the rows that the drives have reached so far: the others have z = 0
  int pivots_ = 0, max_pivots_ = 0, pivots_solved_ = 0;
  int zero_steps_ = 0;  // in a row: degenerate pivots
  Real lowest_schur_ = 0;
  VecX certificate_;
};

extern template class DantzigCore<double>;
extern template class DantzigCore<long double>;

}  // namespace fc::lcp::detail

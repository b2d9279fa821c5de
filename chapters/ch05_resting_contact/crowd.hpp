// The rows of a crowd: too many to be solved exactly, and kept through a frame, in which more come.
#pragma once

#include <span>
#include <vector>

#include "ch03_impulse_lcp/contact.hpp"

namespace fc::resting {

struct CrowdOptions {
  int most_sweeps = 40;    // of a whole solution
  double residual = 1e-3;  // at which it is done, scale-free as in chapter 3
  double enough = 1e-4;    // m/s (or m): when a body has changed by so much its rows are looked at
  double near = 0.02;      // of the largest velocity: a row that closes in slower than this may come to push
  int most_passes = 60;    // of a local one
  double farthest = 1;     // m: a body that was displaced by so much is not pushed on
};

// Velocities of bodies and impulses of rows, and beside them displacements that put gaps right: the same
// rows, with other right-hand sides,
//   w = J v + allowed >= 0,  z'w = 0,    v = v_0 + M^-1 J' z       (m/s, N s)
//   u = J d + room    >= 0,  y'u = 0,    d =       M^-1 J' y       (m, kg m)
// Both by projected Gauss-Seidel, in the bodies' velocities and displacements: all rows in turn, or from some
// rows outwards as far as it matters.
//
// Sweeps do not see J and M. With M^-1 = L L' (L lower triangular for the turning part) and D the diagonal of
// J M^-1 J', they work on the lines of G = D^-1/2 J L, and on what D^1/2 z does to L^-1 v. So a line both
// tells how fast its contact closes in and how an impulse moves its bodies, it is of length one, and fits a
// cache line if Real is float. Impulses and velocities that are told are worked out in double precision.
template <class Real>
class Rows {
 public:
  // A body that no row has heard of yet; all numbers are the caller's.
  struct Twist {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  };

  // Starts anew, with bodies as they are at the frame's start: their velocities are v_0.
  // `reaches`: m, of the bodies' points from their centres; only displace() asks.
  void begin(std::span<const RigidBody> bodies, std::span<const double> reaches = {});
  // A row; returns its number. `impulse` is a guess, and only for those that are there when solve() begins.
  int add(const lcp::Contact& contact, double allowed, double impulse);
  int rows() const { return static_cast<int>(rows_.size()); }

  // All rows, from the guesses. Guesses are scaled, all by one factor, so that they take as much energy as
  // they can: whenever it stops, and if no row asks bodies to part, there is no more kinetic energy than
  // there was (but for the rounding of Real). Returns the residual; `sweeps` counts on.
  double solve(const CrowdOptions& options, int& sweeps);
  // From these rows outwards.
  void relax(std::span<const int> from, const CrowdOptions& options, int& sweeps);
  // Displacements, from rows with slack < 0 outwards. `slack`: of each row, how much more its gap may shrink
  // than it does with the displacements that there are.
  void displace(std::span<const double> slack, const CrowdOptions& options, int& sweeps);
  void forget_displacements();

  // Calls visit(row) for each row of the body.
  template <class Visit>
  void rows_of(int body, Visit&& visit) {
    join_rows();
    for (int k = start_of_[at(body)]; k < start_of_[at(body + 1)]; ++k) visit(row_of_[at(k)]);
  }

  double impulse(int row) const {  // N s
    return static_cast<double>(rows_[at(row)].impulse) / static_cast<double>(rows_[at(row)].root);
  }
  double speed(int row) const;                                             // m/s
  const Twist& velocity(int body) const { return velocities_[at(body)]; }  // m/s, rad/s
  Twist displacement(int body) const;                                      // m, rad
  // Bodies that relax() and displace() have moved since this was last asked.
  std::vector<int> take_touched();
  double residual() const;

 private:
  // Of a body or of a line's end: linear and angular part, and two zeros.
  using Vec8 = Eigen::Matrix<Real, 8, 1>;
  struct Line {
    Vec8 a, b;
  };
  struct Row {
    int a, b;
    Real impulse, allowed, before;  // D^1/2 z, D^-1/2 (J v_0 + allowed)
    Real push, room;                // the same of displacements
    Real root;                      // D^1/2, kg^-1/2
  };
  struct Arms {
    Vec3 normal, a, b;  // m: r x n
    double allowed;     // m/s
  };
  struct Mass {
    double inverse;        // 1/kg
    Vec3 move, root;       // the same along each axis that is free, and its root
    Real reach;            // m^2 by which no point goes farther, if L^-1 of the body's displacement is one
    Mat3 turn, turn_root;  // 1/(kg m^2), and L
  };

  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  static Real along(const Line& line, const Row& row, const std::vector<Vec8>& y) {
    const Vec8 sum = line.a.cwiseProduct(y[at(row.a)]) + line.b.cwiseProduct(y[at(row.b)]);
    return (sum.template head<4>() + sum.template tail<4>()).sum();
  }
  static void apply(const Line& line, const Row& row, Real by, std::vector<Vec8>& y) {
    y[at(row.a)] += by * line.a;
    y[at(row.b)] += by * line.b;
  }
  void touch(int body);
  void join_rows();  // which rows each body has
  void work_out(int body);
  template <bool kVelocity>
  void spread(const CrowdOptions& options, int& sweeps);

  std::vector<Row> rows_;
  std::vector<Line> lines_;
  std::vector<Arms> arms_;
  std::vector<Mass> masses_;
  std::vector<Vec3> places_;
  std::vector<Twist> starts_, velocities_;
  std::vector<Vec8> changes_, displacements_;  // of velocities, and of places: L^-1 of them
  std::vector<Vec8> before_, direction_;
  std::vector<Real> row_direction_;
  std::vector<Real> unsaid_;
  std::vector<int> start_of_,
      row_of_;                       // body i has the rows row_of_[start_of_[i]] ... before start_of_[i + 1]
  std::vector<int> waiting_, next_;  // rows
  std::vector<char> is_waiting_, is_touched_;
  std::vector<int> touched_;
  double scale_ = 0;  // m/s, the largest |b|
};

extern template class Rows<float>;
extern template class Rows<double>;
using Crowd = Rows<float>;

}  // namespace fc::resting

// The rows of a crowd: too many to be solved exactly, and kept through a frame, in which some come and go.
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
class Crowd {
 public:
  // A body that no row has heard of yet; all numbers are the caller's.
  struct Twist {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  };

  // Starts anew, with bodies as they are at the frame's start: their velocities are v_0.
  // `reaches`: m, of the bodies' points from their centres; only displace() asks.
  void begin(std::span<const RigidBody> bodies, std::span<const double> reaches = {});
  // A row; returns its number. `impulse` is a guess, for solve(); after that it acts at once.
  int add(const lcp::Contact& contact, double allowed, double impulse);
  // Takes a row out: its impulse is taken back.
  void remove(int row);
  int rows() const { return static_cast<int>(rows_.size()); }

  // All rows, from the guesses. Guesses are scaled, all by one factor, so that they take as much energy as
  // they can: whenever it stops, and if no row asks bodies to part, there is no more kinetic energy than
  // there was. Returns the residual; `sweeps` counts on.
  double solve(const CrowdOptions& options, int& sweeps);
  // From these rows outwards.
  void relax(std::span<const int> from, const CrowdOptions& options, int& sweeps);
  // Displacements, from rows with slack < 0 outwards. `slack`: of each row, how much more its gap may shrink
  // than it does with the displacements that there are.
  void displace(std::span<const double> slack, const CrowdOptions& options, int& sweeps);

  // Calls visit(row) for each row of the body.
  template <class Visit>
  void rows_of(int body, Visit&& visit) {
    join_rows();
    for (int k = start_of_[static_cast<std::size_t>(body)]; k < start_of_[static_cast<std::size_t>(body) + 1];
         ++k)
      visit(row_of_[static_cast<std::size_t>(k)]);
  }
  void forget_displacements();

  double impulse(int row) const { return rows_[static_cast<std::size_t>(row)].impulse; }
  double speed(int row) const { return along(rows_[static_cast<std::size_t>(row)], velocities_); }  // m/s
  const Twist& velocity(int body) const { return velocities_[static_cast<std::size_t>(body)]; }
  const Twist& displacement(int body) const { return displacements_[static_cast<std::size_t>(body)]; }
  // Bodies that remove(), relax() and displace() have moved since this was last asked.
  std::vector<int> take_touched();
  double residual() const;

 private:
  struct Row {
    Vec3 normal, arm_a, arm_b;  // m: r x n
    Vec3 turn_a, turn_b;        // 1/(kg m): I^-1 (r x n)
    double inverse_a, inverse_b;
    double diagonal, inverse_diagonal;
    double allowed, impulse, before;
    double room, push;  // of displacements
    int a, b;           // a < 0: taken out
  };
  static double along(const Row& row, const std::vector<Twist>& twists);
  static void apply(const Row& row, double by, std::vector<Twist>& twists);
  void touch(int body);
  void join_rows();  // which rows each body has
  template <bool kVelocity>
  void spread(const CrowdOptions& options, int& sweeps);

  std::vector<Row> rows_;
  std::vector<Mat3> turns_;
  std::vector<double> inverse_masses_, reaches_, unsaid_;
  std::vector<Vec3> places_;
  std::vector<Twist> velocities_, displacements_, before_, direction_twists_;
  std::vector<double> direction_;
  std::vector<int> start_of_,
      row_of_;                       // body i has the rows row_of_[start_of_[i]] ... before start_of_[i + 1]
  std::vector<int> waiting_, next_;  // rows
  std::vector<char> is_waiting_, is_touched_;
  std::vector<int> touched_;
  double scale_ = 0;  // m/s, the largest |b|
  bool solved_ = false;
};

}  // namespace fc::resting

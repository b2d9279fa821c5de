// Contacts by the thousand: two problems with one matrix, by projected Gauss-Seidel.
#pragma once

#include <span>
#include <vector>

#include "ch03_impulse_lcp/contact.hpp"
#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// What contacts do to the velocities of bodies, and to the velocities of their paths:
//   velocities  w = J v + approach_limit >= 0,  z'w = 0,  v = v_0 + M^-1 J' z    (m/s, N s)
//   paths       u = J y + room    >= 0,  c'u = 0,  y = y_0 + M^-1 J' c    (m/s, N s)
// One sweep visits each row once, for both: the second computation hides in the memory latency of the first.
//
// J and M do not appear in the loop. With M^-1 = L L' (L lower triangular for the turning part) and D the diagonal of J
// M^-1 J', it works on the lines of G = D^-1/2 J L, and on the change that D^1/2 z makes to L^-1 v. So one line gives
// both how fast its contact closes in and how an impulse moves its bodies; it has length one, and takes 64 bytes in
// single precision. Reported values are computed in double.
class GaussSeidel {
 public:
  virtual ~GaussSeidel() = default;
  virtual void clear();
  // Adds a body at the instant when the impulses act, with its v_0 and y_0.
  void add_body(const RigidBody& body, const Twist& velocity, const Twist& path);
  // Adds a row, with bodies by their numbers here; returns its number. m/s, and guesses in N s, which only count before
  // run().
  int add(const lcp::Contact& contact, double approach_limit, double room, double impulse, double correction);
  // The rows from `first` on belong to two bodies, by their numbers in the world; guesses: N s, on B, of each. A later
  // chapter extends this: here rows push along their normals only.
  virtual void end_pair(int first, int world_a, int world_b, std::span<const Vec3> guesses);
  int rows() const { return static_cast<int>(rows_.size()); }
  int bodies() const { return static_cast<int>(masses_.size()); }

  // Makes this number of sweeps of both problems, from the guesses; more if the kinetic energy would otherwise exceed
  // that of v_0, as after bad guesses. Returns how many.
  int run(int sweeps) { return run<true, true>(sweeps); }
  // Continue with one of the two problems alone.
  int run_velocities(int sweeps) { return run<true, false>(sweeps); }
  int run_paths(int sweeps) { return run<false, true>(sweeps); }
  void set_room(int row, double room);
  // The row's impulse was wrong: from now on it has none. Velocities must be swept again.
  void drop(int row);

  double impulse(int row) const {
    return static_cast<double>(of_row(row).impulse) / static_cast<double>(sources_[at(row)].root);
  }  // N s
  // N s, world, on B: all that acts at the row's point.
  virtual Vec3 whole_impulse(int row) const { return impulse(row) * normal(row); }
  // Rows with the same number share what acts along the surfaces; -1: the row has its own.
  virtual int patch_of(int /*row*/) const { return -1; }
  const Vec3& normal(int row) const { return sources_[at(row)].normal; }
  double start_speed(int row) const { return sources_[at(row)].start; }  // J v_0, m/s
  double path_speed(int row) const;                                      // J y
  // The velocities of the bodies in double precision, from the impulses; J v and J y follow from them.
  void work_out_velocities(std::vector<Twist>& result) const { work_out(false, result); }
  void work_out_paths(std::vector<Twist>& result) const { work_out(true, result); }
  // The worst |min(z, w)| of the velocities' problem over the largest |b|, scaled by the diagonal as in chapter 3.
  double residual() const;

 protected:
  using Vec8 = Eigen::Array<float, 8, 1>;  // linear and angular part, and two zeros
  struct State {                           // L^-1 of what impulses have changed
    Vec8 velocity, path;
  };
  struct Row {            // everything that a sweep reads
    Vec8 line_a, line_b;  // of G: A's part, and B's
    int a, b;
    float impulse, correction;   // D^1/2 z, D^1/2 c
    float approach_limit, room;  // D^-1/2 (J v_0 + approach_limit), D^-1/2 (J y_0 + room)
  };
  struct Source {               // what else is known of a row
    Vec3 normal, arm_a, arm_b;  // m: r x n
    Vec3 point;                 // m
    float root;                 // D^1/2, kg^-1/2
    float path_start;           // D^-1/2 J y_0
    double start;               // m/s, J v_0
  };
  struct Mass {
    Vec3 place, move, root;  // m; 1/kg along each axis that is free, and its root
    Mat3 turn, turn_root;    // 1/(kg m^2), and L
  };
  // Hooks for a later chapter, in this order: rows have got their places; the rest of a sweep, after the rows; the rest
  // of what the guesses do; a row is dropped; all are dropped; the rest of what impulses do to the energy, doubled, and
  // its size (J); their momenta, N s and N m s, added to those of each body.
  virtual void rows_arranged() {}
  virtual void sweep_more(bool /*velocities*/, bool /*paths*/) {}
  virtual void apply_more_guesses() {}
  virtual void row_dropped(int /*row*/) {}
  virtual void drop_all() {}
  virtual void add_gains(double& /*sum*/, double& /*size*/) const {}
  virtual void add_momenta(bool /*paths*/, std::vector<Twist>& /*momenta*/) const {}

  Row& of_row(int row) { return rows_[at(place_[at(row)])]; }
  const Row& of_row(int row) const { return rows_[at(place_[at(row)])]; }
  float speed(const Row& row) const {  // of G, without the part of v_0
    return (row.line_a * states_[at(row.a)].velocity + row.line_b * states_[at(row.b)].velocity).sum();
  }
  template <bool kVelocities, bool kPaths>
  int run(int sweeps);
  template <bool kVelocities, bool kPaths>
  void sweep();
  void apply_guesses();
  bool gains() const;
  void work_out(bool paths, std::vector<Twist>& result) const;

  std::vector<Row> rows_;        // in the order of a sweep
  std::vector<int> place_;       // the place of each row, by its number
  std::vector<Source> sources_;  // of each row by its number
  std::vector<Mass> masses_;
  std::vector<Twist> velocities_, paths_;
  std::vector<State> states_;

 private:
  struct PairRows {  // rows of the same two bodies, added one after the other
    int first, count;
  };
  void arrange();

  int arranged_ = 0;  // rows with a number below this have their place
  std::vector<PairRows> pairs_;
  std::vector<Row> added_;
};

}  // namespace fc::resting

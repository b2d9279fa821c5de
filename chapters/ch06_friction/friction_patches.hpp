// Piles with friction: one patch for each pair of bodies, solved after chapter 5's rows.
#pragma once

#include "ch04_multibody_stepping/world.hpp"
#include "ch05_resting_contact/gauss_seidel.hpp"

namespace fc::friction {

using resting::Twist;

// All contacts of a pair share two tangents and a twist about their centre (the mean of their points, weighted by their
// last impulses): |r_T| <= µ Λ with Λ = Σ λ_i, and |τ| <= µ Σ λ_i ρ_i, ρ_i the distance from the centre. The bounds
// follow the rows' impulses, sweep by sweep. That makes three lines for a pair instead of two for each contact. Limits:
// the law is a disc times an interval, not the true limit surface of these points; a bounce in a pile gives back no
// friction.
class PatchedGaussSeidel : public resting::GaussSeidel {
 public:
  explicit PatchedGaussSeidel(const world::World& world) : world_(world) {}

  void clear() override;
  void end_pair(int first, int world_a, int world_b, std::span<const Vec3> guesses) override;
  // The row's share of its patch: r_T in proportion to the normal impulses, and of the twist in proportion to these and
  // the arms.
  Vec3 whole_impulse(int row) const override;
  int patch_of(int row) const override {
    return resting::at(row) < patch_of_.size() ? patch_of_[resting::at(row)] : -1;
  }

 private:
  struct Line {  // of G: A's part, and B's
    Vec8 a, b;
  };
  struct Patch {
    int a, b;        // bodies, by their numbers here
    int first, end;  // of its rows, among members_
    float mu;
    Line lines[3];                  // for two tangents and the twist, scaled: the tangents by one factor
    float start[3], path_start[3];  // scaled, without impulses
    float impulse[3], correction[3];
    float root, twist_root;
    Vec3 normal, tangents[2], arms_a[2], arms_b[2];  // m: r x t
  };
  struct Member {
    int row, place;
    float inverse_root, distance;  // m, from the centre
    Vec3 arm;                      // m, from the centre to the point, along the surface
  };
  void sweep(Patch& patch, bool velocities, bool paths);
  static void push(const Patch& patch, float load, float moment, const float* start, float* impulse,
                   Vec8& of_a, Vec8& of_b);

  void rows_arranged() override;
  void sweep_more(bool velocities, bool paths) override;
  void apply_more_guesses() override;
  void row_dropped(int row) override;
  void drop_all() override;
  void add_gains(double& sum, double& size) const override;
  void add_momenta(bool paths, std::vector<Twist>& momenta) const override;

  const world::World& world_;
  std::vector<Patch> patches_;
  std::vector<Member> members_;
  std::vector<int> patch_of_;  // of each row, or -1
  std::size_t arranged_ = 0;   // this many patches stand in the order of their rows' places
};

}  // namespace fc::friction

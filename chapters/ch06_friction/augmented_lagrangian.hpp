// All contacts of an island at once, by a matrix of its bodies: for structures that stand, where solving one contact
// after the other takes thousands of sweeps.
//
// If the shifts s = µ|u_T| of the law K* ∋ u + s n ⟂ r ∈ K were known, r would minimise a convex function, and v would be the
// minimum of another: its augmented Lagrangian (Hestenes 1969, Powell 1969; Rockafellar 1976). From a guess r̄, with a stiffness σ
// of each contact (kg),
//
//     φ(y) = ½ |y|² + Σ |P_K(r̄ - σ (u(y) + s n))|² / 2σ,    u(y) = u_0 + G y,   G = J L,   M⁻¹ = L L',
//
// where y is the change that impulses make to the bodies' velocities, scaled by their masses. At the minimum y = G'r
// with r = P_K(...): these r are the next r̄. σ need not be infinite: the error shrinks by 1/(1 + σλ) each time, λ an
// eigenvalue of J M⁻¹ J'. And since I + G' σ D G is positive definite, redundant contacts do no harm and need not be
// found. Newton's method with a line search finds the minimum; P_K has derivatives (D) where the contact's state does
// not change. s is that of the last u, as in Cadoux's fixed point (2009), accelerated by Aitken's rule.
#pragma once

#include <functional>
#include <vector>

#include "ch06_friction/body_matrix.hpp"
#include "ch06_friction/contact_block.hpp"

namespace fc::friction {

class AugmentedLagrangian {
 public:
  struct Piece {  // P_K and its derivative
    Vec3 impulse = Vec3::Zero();
    Mat3 D = Mat3::Zero();
  };
  // Starts from the blocks' r, and changes these alone. Bodies, blocks and matrix must outlive it. A matrix that is used again
  // for the same bodies keeps its order of elimination.
  AugmentedLagrangian(std::span<const MovedBody> bodies, std::span<ContactBlock> blocks, BodyMatrix& matrix);

  // What contacts obey: Coulomb's law; or, after hold(), normal impulses as without friction, and, for contacts with
  // holds[i], tangents that do not move.
  void hold(std::span<const char> holds) { holds_ = holds; }

  // Runs at most this many rounds. left: the residual that the blocks' r leave, counted from 0 on; rounds go on until
  // it is `enough`, or falls no more. The blocks get the best r; returns the residual that it leaves.
  double run(int most, double enough, const std::function<double()>& left);
  int factors() const { return factors_; }  // factorisations so far

 private:
  using Mat36 = Eigen::Matrix<double, 3, 6>;
  using Mat6 = BodyMatrix::Mat6;
  Piece piece(std::size_t k, const Vec3& x) const;
  Vec3 velocity(std::size_t k, const VecX& y) const;
  Vec3 argument(std::size_t k, const VecX& y) const;
  void add_impulse(std::size_t k, const Vec3& r, VecX& y) const;
  double value(const VecX& y) const;
  VecX linearise(const VecX& y);
  void factor();
  VecX start_round();
  void shift(const VecX& y, int round);
  void minimise(VecX& y);
  double settle(double best, const std::function<double()>& left);
  double stick(double best, const std::function<double()>& left);
  bool adapt(double now, double before);

  std::span<ContactBlock> blocks_;
  std::span<const char> holds_;
  std::vector<int> place_a_, place_b_;  // the place of each block's bodies among those that move, or -1
  std::vector<Mat36> a_, b_;            // G's parts
  std::vector<Vec3> guess_;             // r̄
  std::vector<Vec3> stiffness_;
  std::vector<char>
      inside_;  // while it settles, of each contact: 1, its normal impulse is free; 2, all of it
  std::vector<double> shift_, shift_change_;
  double stiff_ = 0, stiffest_ = 0;  // σ over the trace of a contact's block, now and at most
  bool sticks_ = false, jumped_ = false;
  int size_ = 0, factors_ = 0;
  std::vector<Mat3> slopes_, factored_;     // σ D of each contact, at y, and in the matrix
  std::vector<std::pair<int, int>> links_;  // places of bodies that touch
  BodyMatrix& matrix_;                      // I + G' σ D G
};

}  // namespace fc::friction

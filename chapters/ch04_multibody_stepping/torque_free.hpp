// The rotation of a rigid body on which no torque acts: exact at any time, and bounded for all time.
#pragma once

#include "ch01_convex_advancement/motion.hpp"
#include "ch04_multibody_stepping/principal_inertia.hpp"
#include "ch04_multibody_stepping/theta_series.hpp"
#include "common/types.hpp"

namespace fc::world {

// Without torque the angular momentum L and the kinetic energy E are constant, but the spin w is not: it wanders around
// L (Euler's equations). In body axes, L follows the curve in which the sphere |L| = const meets the ellipsoid 2E = sum
// L_i^2 / I_i, as Jacobi's elliptic functions of time. The turn about L that remains is a steady one plus the phase of
// a theta function (Jacobi 1849).
//
// Accuracy, with eps = 2.2e-16 and the angle turned a = spin_bound() |t| in rad: for principal moments as given,
// rotation_at(t) is within 16 eps (1 + a) of the exact motion (Frobenius norm), and spin_at(t) within 16 eps (1 + a) of
// the largest |w|. The exact motion is that of a start whose spin is within 8 eps of long double (relative) of the
// given one. This matters only for a body that turns almost about its middle axis, where any difference grows.
// Therefore a spin that leans from a principal axis by less than 8 eps, and whose angular momentum does too, is taken
// to be along the axis.
class TorqueFree : public ca::VaryingSpin {
 public:
  // `rotation` turns body axes into world axes at t = 0; `spin` is the spin at t = 0 in world axes, rad/s. Throws
  // std::invalid_argument if either is not finite, or `rotation` is not orthonormal to 1e-9.
  TorqueFree(const PrincipalInertia& inertia, const Mat3& rotation, const Vec3& spin);
  TorqueFree(const Mat3& inertia, const Mat3& rotation, const Vec3& spin)
      : TorqueFree(PrincipalInertia(inertia), rotation, spin) {}

  // At any time t (s), also before 0. Nothing is allocated, and nothing depends on earlier calls.
  Mat3 rotation_at(double t) const override;  // body axes to world axes
  Vec3 spin_at(double t) const override;      // rad/s, world axes

  // Bounds for all time, before and after 0, each rounded up by 32 eps of the largest |w| (or |dw/dt|).
  //
  // |w|, in rad/s. Each of the three products (I_i - I1)(I3 - I_i) is >= 0. Their sum with weights w_i^2 is
  // 2E (I1 + I3) - L^2 - I1 I3 |w|^2, so
  //   |w|^2 <= (2E (I1 + I3) - L^2) / (I1 I3),   with equality when w_2 = 0: twice in every period.
  double spin_bound() const override { return spin_bound_; }

  // |n x w|, in rad/s, for a unit vector n that is fixed in the world. As L.w = 2E, the part of w along L has the
  // constant size 2E/|L|, and the rest is at most sqrt(|w|max^2 - 4E^2/L^2): w stays in a cone about L. With l = L/|L|,
  // the angle between n and w is at most the angle between n and l plus the cone's:
  //   |n x w| <= (2E/|L|) |n x l| + sqrt(|w|max^2 - 4E^2/L^2) |n.l|   if the sum is at most a right angle
  // (|w|max times the sine of the sum), and |w|max if not.
  double turning_bound(const Vec3& n) const override {
    const double sine = momentum_axis().cross(n).norm(), cosine = std::abs(momentum_axis().dot(n));
    const bool acute = cosine * along_ >= sine * across_;
    return (acute ? sine * along_ + cosine * across_ + margin_ : spin_bound_);
  }

  // |w - (w.L) L/L^2|, in rad/s: the largest part of the spin across L, the cone's radius.
  double across_bound() const override { return constant_ ? 0 : across_ + margin_; }

  // |dw/dt|, in rad/s^2, is at most (|L|/I2) sqrt(|w|max^2 - 4E^2/L^2), with equality when w_2 = 0 (the
  // source has the proof; it needs that I3 <= I1 + I2).
  double spin_change_bound() const override { return spin_change_bound_; }

  // The direction of L in the world, which is constant (that of the spin, if the spin is constant; the x axis, if it is
  // zero).
  Vec3 momentum_axis() const { return world_.col(0); }
  // w does not change: a sphere, a spin about a principal axis, or none.
  bool constant_spin() const { return constant_; }

 private:
  struct State;  // L's direction in the body, and the turn about it
  struct Start;  // the start in principal axes, in more digits

  State state_at(double t) const;
  Mat3 turned(double cosine, double sine) const;  // world_ turned about L
  Mat3 world_frame(const State& state) const;
  void set_constant(const Mat3& rotation, const Vec3& spin_world);
  void set_axes(const PrincipalInertia& inertia, const Start& start);
  void set_bounds(const Start& start);
  void set_series(const Start& start);

  bool constant_ = true;
  Mat3 body_ = Mat3::Identity();   // columns: the axis that L circles, the middle one, the other; body axes
  Mat3 world_ = Mat3::Identity();  // columns: L's direction, and two more that turn about it; world, t = 0
  Vec3 rates_ = Vec3::Zero();      // |L| / moments, rad/s, of the columns of body_
  double along_ = 0, across_ = 0;  // rad/s: the spin along L, and its largest part across L
  double spin_bound_ = 0, spin_change_bound_ = 0, margin_ = 0;

  ThetaSeries series_;
  double phase_start_ = 0, phase_rate_ = 0;  // u = phase_start + phase_rate t, the series' argument
  double precession_ = 0;                    // the mean rate of the turn about L, rad/s
  double side_ = 1;                          // the sign of L along the axis that it circles
  Vec3 size_ = Vec3::Zero();                 // the largest components of L's direction
};

// From the motion's start on no torque acts: the spin follows Euler's equations. A body whose spin stays constant
// anyway (a ball, or one that spins about a principal axis) is left as it is.
void turn_freely(ca::Motion& motion, const PrincipalInertia& inertia);

}  // namespace fc::world

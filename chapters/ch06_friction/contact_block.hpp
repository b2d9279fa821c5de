// A contact with friction between two bodies, for solvers that never form an island's matrix J M⁻¹ J'.
#pragma once

#include <span>

#include "ch03_impulse_lcp/contact.hpp"
#include "ch06_friction/one_contact.hpp"

namespace fc::friction {

inline std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

// The columns: a contact's normal (unit) and two tangents. The choice of tangents changes nothing: each contact is
// solved exactly.
Mat3 contact_frame(const Vec3& normal);

struct MovedBody {
  Vec3 place;                     // m
  Vec3 velocity, spin;            // m/s and rad/s, with all impulses
  Vec3 free_velocity, free_spin;  // without impulses
  Vec3 move;                      // 1/kg along each free axis
  Mat3 turn;                      // 1/(kg m^2)

  bool moves() const { return !move.isZero(0) || !turn.isZero(0); }
};

struct ContactBlock {
  int a, b;
  Mat3 frame;         // columns: normal, two tangents
  Vec3 arm_a, arm_b;  // m; zero for a body that cannot turn
  Mat3 delassus;      // 1/kg, in the frame
  OneContact one;
  double mu;
  Vec3 offset;  // m/s, in the frame
  Eigen::Matrix2d inverse =
      Eigen::Matrix2d::Zero();  // kg, of the tangents' part of delassus, where it is not zero
  Vec3 r = Vec3::Zero();        // N s, in the frame
  Vec3 start = Vec3::Zero();    // m/s, u without impulses

  // The relative velocity in the frame, m/s, from the bodies' present velocities; without the offset.
  Vec3 relative_velocity(std::span<const MovedBody> bodies) const;
  // Applies an impulse (N s, in the frame) to both bodies.
  void push(std::span<MovedBody> bodies, const Vec3& impulse) const;
};

Mat3 cross_matrix(const Vec3& v);

}  // namespace fc::friction

// Contacts with friction between bodies, solved one contact at a time: the method of gauss_seidel.hpp, on bodies
// instead of a matrix, so that the cost of a sweep is proportional to the number of contacts.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "ch06_friction/body_matrix.hpp"
#include "ch06_friction/contact_block.hpp"

namespace fc::friction {

// Three lines for each contact, one where there is no friction. The bodies' velocities include all impulses.
class ContactSweeps {
 public:
  // Begins with the bodies as they are without impulses (with their velocities, and without a correction, u = J v +
  // offset). least: m/s, a lower limit for the largest velocity in the problem.
  void start(std::span<const RigidBody> bodies, double least = 0);
  // Adds a contact. mu: >= 0. offset: m/s, world, is added to its velocity; along the normal it is the speed at which
  // the contact may close in. impulse: N s, world, on B, a guess.
  void add(const lcp::Contact& contact, double mu, const Vec3& offset, const Vec3& impulse);
  int contacts() const { return static_cast<int>(blocks_.size()); }

  // Coulomb's law for all contacts. Sweeps until no impulse changes by more than `tolerance` (of the largest velocity
  // in the problem), at most `most` times. Sweeps that go in circles are relaxed. Returns the residual that was
  // reached, see residual().
  double run(int most, double tolerance);
  // Normal impulses as without friction, and contacts with holds[i] do not move along their tangents. Returns the worst
  // violation of both, over the largest velocity without impulses or due to them.
  double run_held(std::span<const char> holds, int most, double tolerance);
  // Continue either of these by the matrix of the bodies, see augmented_lagrangian.hpp: at most `most` rounds, down to
  // a residual.
  double run_together(int most, double enough);
  double run_held_together(std::span<const char> holds, int most, double enough);
  // Normal impulses are given (N s); friction is at most mu times these.
  void run_discs(std::span<const double> normals, int most, double tolerance);

  // The worst violation of Coulomb's law at a contact (cone_violation), over the largest velocity without impulses or due to them.
  double residual() const;

  // Contact visits since the last call; a factorisation takes as long as many visits to each contact.
  double take_work() { return std::exchange(work_, 0.0); }

  Vec3 impulse(int contact) const {
    return blocks_[index(contact)].frame * blocks_[index(contact)].r;
  }  // N s, world, on B

 private:
  Vec3 velocity(const ContactBlock& block) const {
    return block.relative_velocity(bodies_) + block.offset;
  }  // m/s, in the frame
  void apply_impulses();
  double together(std::span<const char> holds, int most, double enough, const std::function<double()>& left);
  double held_residual(std::span<const char> holds) const;
  template <class Solve>
  double sweep(bool backwards, double relaxation, const Solve& solve);
  template <class Solve>
  void run(int most, double tolerance, const Solve& solve);
  double largest_velocity() const;

  double least_ = 0, work_ = 0;
  std::vector<MovedBody> bodies_;
  std::vector<ContactBlock> blocks_;
  BodyMatrix matrix_;
};

}  // namespace fc::friction

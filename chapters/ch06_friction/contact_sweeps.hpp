// Contacts with friction between bodies, solved one contact at a time: the same method as gauss_seidel.hpp, but it sees bodies
// and not a matrix, so that a sweep costs as much as there are contacts.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "ch06_friction/contact_block.hpp"

namespace fc::friction {

// Three lines a contact, one where there is no friction. Velocities of bodies are those with all impulses.
class ContactSweeps {
 public:
  // Bodies as they are without impulses (their velocities: without a correction, u = J v + offset).
  // least: m/s, the largest velocity in the problem counts as no less.
  void start(std::span<const RigidBody> bodies, double least = 0);
  // Adds a contact: mu >= 0; offset: m/s, world, what is added to its velocity: along the normal with how much it may close in.
  // impulse: N s, world, on B, a guess.
  void add(const lcp::Contact& contact, double mu, const Vec3& offset, const Vec3& impulse);
  int contacts() const { return static_cast<int>(blocks_.size()); }

  // Coulomb's law for all. Sweeps until no impulse changes by more than `tolerance` (of the largest velocity in the problem),
  // at most so many. Where sweeps go in circles they are relaxed. The residual that was reached, see residual().
  double run(int most, double tolerance);
  // Normal impulses as without friction; contacts with holds[i] do not move along their tangents. The worst of what is left of both,
  // over the largest velocity without impulses or due to them.
  double run_held(std::span<const char> holds, int most, double tolerance);
  // Both by the matrix of the bodies, see augmented_lagrangian.hpp, from what was reached: at most so many rounds, down to a residual.
  double run_together(int most, double enough);
  double run_held_together(std::span<const char> holds, int most, double enough);
  // Normal impulses as given (N s); friction is of at most mu times these.
  void run_discs(std::span<const double> normals, int most, double tolerance);

  // The worst violation of Coulomb's law at a contact (cone_violation), over the largest velocity without impulses or due to them.
  double residual() const;

  // Contacts that were looked at since the last query; a step of Newton's method takes as long as many looks at each.
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
};

}  // namespace fc::friction

// Contacts with friction between bodies, solved one contact at a time: the same method as gauss_seidel.hpp, but it sees bodies
// and not a matrix, so that a sweep costs as much as there are contacts.
#pragma once

#include <span>
#include <vector>

#include "ch03_impulse_lcp/contact.hpp"
#include "ch06_friction/one_contact.hpp"

namespace fc::friction {

// The columns: a contact's normal (unit) and two tangents. Nothing depends on which: each contact is solved exactly.
Mat3 contact_frame(const Vec3& normal);

// Three lines a contact, one where there is no friction. Velocities of bodies are those with all impulses.
class ContactSweeps {
 public:
  // Bodies as they are without impulses (their velocities: without a correction, u = J v + offset).
  void start(std::span<const RigidBody> bodies);
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
  // Normal impulses as given (N s); friction is of at most mu times these.
  void run_discs(std::span<const double> normals, int most, double tolerance);

  // The worst violation of Coulomb's law at a contact (cone_violation), over the largest velocity without impulses or due to them.
  double residual() const;

  Vec3 impulse(int contact) const {
    return blocks_[index(contact)].frame * blocks_[index(contact)].r;
  }  // N s, world, on B

 private:
  struct Mass {
    Vec3 place, velocity, spin;
    Vec3 move;  // 1/kg along each axis that is free
    Mat3 turn;  // 1/(kg m^2)
  };
  struct Block {
    int a, b;
    Mat3 frame;         // columns: normal, two tangents
    Vec3 arm_a, arm_b;  // m; zero on a body that is not turned
    Mat3 delassus;      // 1/kg, in the frame
    OneContact one;
    double mu;
    Vec3 offset;  // m/s, in the frame
    Eigen::Matrix2d inverse =
        Eigen::Matrix2d::Zero();  // kg, of the tangents' part of delassus, where it is not zero
    Vec3 r = Vec3::Zero();        // N s, in the frame
    Vec3 start;                   // m/s, u without impulses
  };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  Vec3 relative_velocity(const Block& block) const;  // m/s, in the frame
  void push(const Block& block, const Vec3& impulse);
  template <class Solve>
  double sweep(bool backwards, double relaxation, const Solve& solve);
  template <class Solve>
  void run(int most, double tolerance, const Solve& solve);
  double largest_velocity() const;

  std::vector<Mass> bodies_;
  std::vector<Block> blocks_;
};

}  // namespace fc::friction

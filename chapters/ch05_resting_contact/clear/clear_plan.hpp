// A plan of an island in the making: its rows, its ends, and the proof of its paths, in the plainest way. See
// clear_resting.hpp.
#pragma once

#include "ch05_resting_contact/clear/resting_step.hpp"
#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// The members of the island, and the bodies that no impulse moves; at the poses of the instant.
class ClearPlan {
 public:
  ClearPlan(const world::World& world, Contacts& contacts, clear::RestingStepFunction* resting_step,
            const clear::LcpFunction& solve_lcp, const Island& island, double now, double length);

  // Whether there are rows that close_ends() has not yet seen: at first, and after a prove() that found new ones.
  bool has_new_rows();
  // Pushes and corrects until the gaps at the plan's end agree with the rows.
  bool close_ends();
  // Whether all bodies that push are in contact at both ends, and all paths are clear of each other. Where paths are
  // not, the points that the pair has at their ends become rows.
  bool prove();
  // Marks the points of pushed pairs that are in contact at both ends. If such a point closes at the plan's end, this
  // is the other half of its force, not an impact.
  void remember() const;

  double now, length;  // s
  std::vector<Member> members;
  clear::RestingProblem problem;  // bodies by their places among the members
  clear::RestingResult result;
  std::vector<char> planned;  // of each member: it is pushed, or ends in contact; all others fly

 private:
  // A row's contact point, and its gap at the plan's end (m).
  struct Point {
    PairContacts* pair;
    ContactPoint point;
    double end_gap = 0;
  };
  void add_row(PairContacts& pair, int a, int b, const ContactPoint& point);
  void follow_paths();
  double measure(int row);
  bool is_clear(int i, int j);

  const world::World& world_;
  Contacts& contacts_;
  clear::RestingStepFunction* resting_step_;
  const clear::LcpFunction& solve_lcp_;
  std::vector<Path> paths_;      // of the members
  std::vector<RigidBody> ends_;  // where the members stand at the paths' ends, with velocities w
  std::vector<Point> points_;    // of the rows
  int proofs_ = 0;               // so far
  std::ptrdiff_t known_ = 0;     // rows at the last proof
};

}  // namespace fc::resting

// A plan of an island in the making: its rows, its ends, and the proof of its paths. In the plainest way: see clear_resting.hpp.
#pragma once

#include "ch05_resting_contact/clear/resting_step.hpp"
#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

// The members of the island, and all that no impulse moves; they stand where they are at the instant.
class ClearPlan {
 public:
  ClearPlan(const world::World& world, Contacts& contacts, clear::RestingStepFunction* resting_step,
            const clear::LcpFunction& solve_lcp, const Island& island, double now, double length);

  // Whether there are rows that close_ends() has not seen yet: at first, and after a prove() that found new ones.
  bool has_new_rows();
  // Pushes and corrects, until the gaps at the plan's end are what the rows say.
  bool close_ends();
  // Whether all that push are in contact, at both ends, and all paths are clear of each other. The points that a pair has at
  // the end of paths that are not clear become rows.
  bool prove();
  // Where the plan has pushed two bodies, their points that are in contact at both ends are marked: that these close at its end
  // is the other half of their force, and no impact.
  void remember() const;

  double now, length;  // s
  std::vector<Member> members;
  clear::RestingProblem problem;  // bodies by their places among the members
  clear::RestingResult result;
  std::vector<char> planned;  // of each member: it is pushed, or ends in contact; the others fly

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
  std::vector<RigidBody> ends_;  // at the end of these, with velocities w
  std::vector<Point> points_;    // of the rows
  int proofs_ = 0;               // up to now
  std::ptrdiff_t known_ = 0;     // rows, at the last of them
};

}  // namespace fc::resting

// The rows of a plan: the points at which its bodies push each other, and how hard.
#pragma once

#include "ch05_resting_contact/contact_law.hpp"
#include "ch05_resting_contact/courses.hpp"
#include "ch05_resting_contact/stage_times.hpp"

namespace fc::resting {

enum class PlanResult { proved, unproved, meets, changes, unsolved };

struct PlanRow {
  int pair;  // among the candidates
  ContactPoint point;
  lcp::Contact contact;           // as it is now; bodies by their places among the members
  double bend = 0;                // m, by which the gap at the end differs from its first-order value
  Vec3 slip_bend = Vec3::Zero();  // m/s, see ContactSet
  double keep = 0, want = 0;      // m, at the end: for velocities, and for paths
  Vec3 impulse = Vec3::Zero();    // N s, on B
  Vec3 early = Vec3::Zero();      // N s, see without_arrivals()
  double correction = 0;          // N s
  double end_gap = 0;             // m
  bool arrives = false;           // not in contact now: its impulse acts at the plan's end
  // m/s: velocities are made to part by no more than this, since no more is taken back at the end
  double most_push = std::numeric_limits<double>::infinity();

  double push() const { return impulse.dot(contact.normal); }  // N s
};

// The gap (m) that a contact with this gap should have at a plan's end, where h is the margin: one nearer to h / 2.
double wanted_gap(double gap, double margin);

// Solves the rows of a plan for the bodies of `courses`. With v, the velocities now, and u, the mean velocity of free
// flight during the plan (v + dt g/2 without drag):
//   1. push    velocities w = u + M^-1 J'z: z >= 0, every gap at the plan's END >= min(gap, margin/2), z only where it is that;
//   2. correct path velocities y = w + M^-1 J'c: the same with ends that bring gaps nearer to margin/2; velocities stay w.
// The gap at the end is measured where the bodies will stand, not to first order: the rows' right-hand sides are
// corrected until both agree (a chord method).
class PlanRows {
 public:
  PlanRows(Courses& courses, ContactLaw& law, double margin)
      : courses_(courses), law_(law), margin_(margin) {}

  void start(const IslandOptions& options);  // no rows yet; all members fly
  // The row for a point of a candidate, to be added to `rows`.
  PlanRow row_of(const world::World& world, int candidate, const ContactPoint& point, bool arrives) const;
  // Solves until the gaps at the end agree with the rows. Afterwards the members' courses are those with `path`.
  PlanResult close();

  // The time (s) up to which impulses of contacts that last can act evenly.
  double holds_until();
  // The members as contacts that last alone would make them; the rows get the impulses for this.
  std::vector<RigidBody> without_arrivals();
  // The contact's velocity (m/s) at the end of the paths, with these velocities of the bodies.
  double end_speed(const PlanRow& row, const std::vector<RigidBody>& bodies) const;

  std::vector<PlanRow> rows;
  std::vector<RigidBody> fast, path;  // the members with velocities w, and with y
  int solves = 0;
  double residual = 0;  // the worst of these solutions
  IslandResult failed;  // the last that failed
  StageTimes times;     // since they were set to zero

 private:
  PlanResult close_ends();
  double measure(PlanRow& row) const;
  bool solve();
  bool correct();
  void gather(bool arrivals);
  bool push(std::vector<RigidBody>& bodies);
  bool counts(const IslandResult& result);
  double bend(const PlanRow& row) const;
  Vec3 slip_bend(const PlanRow& row) const;

  Courses& courses_;
  ContactLaw& law_;
  double margin_;  // m
  IslandOptions options_;
  bool corrects_ = true;
  std::vector<PlanRow*> gathered_;  // the rows for the law, and for each of them:
  std::vector<lcp::Contact> contacts_;
  std::vector<double> approach_limits_, corrections_;
  std::vector<Vec3> bends_, impulses_;
  std::vector<int> numbers_;  // of the members in the world
};

}  // namespace fc::resting

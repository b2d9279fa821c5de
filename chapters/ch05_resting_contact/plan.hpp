// A plan: how the bodies of an island go on together for a while, as contacts that last let them.
#pragma once

#include "ch05_resting_contact/contact_law.hpp"
#include "ch05_resting_contact/courses.hpp"

namespace fc::resting {

// A row of a plan, and what it does: for contacts.csv.
struct PlannedRow {
  lcp::Contact contact;  // bodies by their numbers in the world
  // N s, on B: of the whole plan; of it what acts evenly all the time, and not at its end; what it gives back at the plan's end.
  Vec3 impulse = Vec3::Zero(), early = Vec3::Zero(), back = Vec3::Zero();
  // m/s, of B's point as seen from A's, without and with the plan's impulses.
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  std::uint64_t key = 0;  // of its point
  int patch = -1;         // see world::ImpactRecord
  bool arrives = false;   // it was not in contact at the start: what it does, it does at the plan's end
};

// What a plan's bodies do. An event may end it before its time: then only that share of what acts all the time has acted, and
// nothing of what acts at its end: what arrives there, and what that causes.
struct Planned {
  std::vector<int> bodies;  // by their numbers in the world
  std::vector<world::Plan> motions;
  std::vector<Twist> arrivals;                // what velocities get at the plan's end
  int pushing = 0;                            // contacts with an impulse,
  std::vector<PlannedRow> rows;               // and what they do
  double kinematic_work = 0, early_work = 0;  // J, done by kinematic bodies, in all and all the time
  double correction = 0;                      // m, by which a body's point is moved at most to put gaps right
};

struct PlanOptions {
  IslandOptions solver;
  double rest_speed = 0;   // m/s: what comes in faster ends the plan when it is there
  bool may_change = true;  // the plan may end where its impulses have to change
};

// A motion of which velocities begin as the member's and end as `end`, without what it gets on arrival.
world::Plan planned_motion(const Member& member, const Twist& path, const Twist& end, double length);

// The gap (m) that a contact with this gap should have at a plan's end, where h is the margin: nearer to h / 2.
double wanted_gap(double gap, double margin);

// Makes plans. One at a time; what the last make() found can be queried until the next.
//
// From v, the velocities now, and with u, the mean velocity of free flight in the plan's time (v + dt g/2 without drag):
//   1. push    velocities w = u + M^-1 J'z: z >= 0, every gap at the plan's END >= min(gap, margin/2), z only where it is that;
//   2. correct path velocities y = w + M^-1 J'c: the same with ends that bring gaps nearer to margin/2; no velocity hears of it;
//   3. prove   the paths: straight, with constant spin, from now to the end; where one is not clear, what it meets becomes a row.
// The gap at the end is that of the bodies as they will stand there, not its first order: the rows' right-hand sides are
// corrected until both agree (a chord method). This is RATTLE's first half (Andersen 1983) with inequalities; the second half,
// which lets velocities end with no contact closing, is the next instant's impact law.
class PlanMaker {
 public:
  PlanMaker(Contacts& contacts, ContactLaw& law)
      : contacts_(contacts), law_(law), courses_(contacts, false) {}

  enum class Result { proved, unproved, meets, changes, unsolved };
  // For `length` seconds from `now` on (s in the frame).
  Result make(const world::World& world, const Island& island, double now, double length,
              const PlanOptions& options);
  // What was made. The forces that it found are guesses for the next plan.
  Planned take();

  // If it meets or changes: when the first two bodies that bounce are there, or impulses have to change, s from the plan's start.
  double meeting() const { return meeting_; }
  double worst_residual() const { return residual_; }
  lcp::Status status() const { return status_; }  // of the last solution that failed,
  int steps() const { return steps_; }            // and its pivots, sweeps or steps
  int solves() const { return solves_; }
  int checked() const { return courses_.checked(); }

 private:
  struct Row {
    int pair;  // among the candidates
    ContactPoint point;
    lcp::Contact contact;           // bodies by their places among the members
    double gap = 0;                 // m, now
    double bend = 0;                // m, by which the gap at the end differs from its first order
    Vec3 slip_bend = Vec3::Zero();  // m/s, see ContactSet
    double keep = 0, want = 0;      // m, at the end: for velocities, and for paths
    Vec3 impulse = Vec3::Zero();    // N s, on B
    double correction = 0;          // N s
    double end_gap = 0;
    double most_push = std::numeric_limits<double>::
        infinity();  // m/s: velocities are made to part by no more, since no more is taken back at the end
    bool arrives = false;  // not in contact now: what the row does, it does at the plan's end

    double push() const { return impulse.dot(contact.normal); }  // N s
    double approach_limit(double length) const {                 // m/s
      return std::max((gap + bend - keep) / length, -most_push);
    }
  };
  void add_row(const world::World& world, int candidate, const ContactPoint& point, bool arrives);
  bool solve();
  bool push(std::vector<RigidBody>& bodies);
  bool correct();
  bool counts(const IslandResult& result);
  ContactSet set_of(std::vector<RigidBody>& bodies);
  Result close_ends();
  bool gains() const;
  std::vector<RigidBody> without_arrivals(std::vector<Vec3>& early);
  void remember() const;
  Vec3 slip_bend(const Row& row) const;
  double holds_until();
  double arrival(const Row& row) const;
  bool add_rows_of(const world::World& world, int candidate);
  double end_speed(const Row& row, const std::vector<RigidBody>& bodies) const;

  Contacts& contacts_;
  ContactLaw& law_;
  Courses courses_;
  PlanOptions options_;
  std::vector<RigidBody> fast_, path_;  // of each member, with velocities w, and y
  std::vector<Row> rows_;
  std::vector<lcp::Contact> contact_list_;
  std::vector<double> approach_limits_, corrections_;
  std::vector<Vec3> bends_, impulses_;
  std::vector<int> numbers_;  // of the members in the world
  double residual_ = 0, meeting_ = 0;
  bool corrects_ = true;
  lcp::Status status_ = lcp::Status::limit;
  int solves_ = 0, steps_ = 0;
};

}  // namespace fc::resting

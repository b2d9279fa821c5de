// A plan: how the bodies of an island go on together for a while, as contacts that last let them.
#pragma once

#include "ch05_resting_contact/island.hpp"
#include "ch05_resting_contact/island_solver.hpp"

namespace fc::resting {

// A row of a plan, and what it did: for contacts.csv.
struct PlannedRow {
  lcp::Contact contact;           // bodies by their numbers in the world
  double impulse = 0;             // N s, of the whole plan
  double before = 0, after = 0;   // m/s, the contact's velocity without and with the plan's impulses
  std::uint64_t key = 0;          // of its point
  bool arrives = false;           // it was not in contact at the start: what it does, it does at the plan's end
};

struct PlanOptions {
  IslandOptions solver;
  double rest_speed = 0;  // m/s: what comes in faster ends the plan when it is there
  bool exact = true;      // false: it arrives at the plan's end
  int most_rounds = 8;    // in which the paths' ends are looked at again
  double closed = 1e-6;   // of the margin: how exactly contacts must close at the plan's end
};

// Makes plans. One at a time; what the last make() found can be asked until the next.
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
  PlanMaker(Contacts& contacts) : contacts_(contacts) {}

  enum class Result { proved, unproved, meets, unsolved };
  // For `length` seconds from `now` on (s in the frame).
  Result make(const world::World& world, const Island& island, double now, double length,
              const PlanOptions& options);

  // Of each member: whether it goes by the plan, and how; whether something pushes it.
  bool is_planned(int member) const { return planned_[at(member)]; }
  bool is_pushed(int member) const { return pushed_[at(member)]; }
  world::Plan plan_of(int member) const;
  // What its velocities get at the plan's end, from contacts that only arrive there.
  Twist arrival_of(int member) const { return arrivals_[at(member)]; }
  std::vector<PlannedRow> rows() const;
  // Pairs whose paths are not clear, and for which part of the time (0 to 1) they are.
  struct Unproved {
    int a, b;  // members
    double share;
  };
  const std::vector<Unproved>& unproved() const { return unproved_; }
  // Lets the members go only a share of their paths, and keep as much of their velocities, so that all pairs are clear.
  // Returns the momentum that this takes, kg m/s; `count`: the bodies that are shortened.
  double shorten(const world::World& world, int& count);
  // Kinematic bodies (by their numbers in the world) that the last shorten() found to go into what stands.
  const std::vector<int>& blocked() const { return blocked_; }

  // If it meets: when the first two bodies that bounce are there, s from the plan's start.
  double meeting() const { return meeting_; }
  double worst_residual() const { return residual_; }
  lcp::Status status() const { return status_; }  // of the last solution that failed
  int solves() const { return solves_; }
  int sweeps() const { return sweeps_; }
  int checked() const { return checked_; }
  double largest_correction() const { return correction_; }  // m, by which a body's point was moved
  double kinematic_work() const;                              // J, done by kinematic bodies

 private:
  struct Row {
    int pair;  // among candidates_
    ContactPoint point;
    lcp::Contact contact;  // bodies by their places among the members
    double gap = 0;        // m, now
    double bend = 0;       // m, by which the gap at the end differs from its first order
    double keep = 0, want = 0;  // m, at the end: for velocities, and for paths
    double impulse = 0, correction = 0;
    double end_gap = 0;
    double most_push = 0;  // m/s: velocities are made to part by no more, since no more is taken back at the end
    bool arrives = false;
  };
  struct Candidate {
    PairContacts* contacts;
    int a, b;
    bool clear = false;
    bool in_contact = false;  // it has rows
    double time = 0;
  };
  // Not in contact now: what the row does, it does at the plan's end.
  bool arrives(const Row& row) const { return row.arrives || row.gap > contacts_.margin(); }
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  void start(const world::World& world, const Island& island, double now);
  void add_row(const world::World& world, int candidate, const ContactPoint& point, bool arrives);
  bool solve();
  bool close_ends();
  bool is_closed() const;
  double end_speed(const Row& row, const Track& a, const Track& b) const;
  bool comes_in_fast(const IslandPair& pair) const;
  void follow(int member);
  void find_candidates(const world::World& world, double now);
  int candidate_of(PairContacts* contacts, int a, int b);
  bool prove(const world::World& world);
  bool is_event(const Candidate& pair) const;
  bool add_rows_of(const world::World& world, int candidate);
  double need(const world::World& world, const Candidate& pair) const;
  PathVerdict check(const world::World& world, Candidate& pair, const Track& a, const Track& b);
  void settle();

  Contacts& contacts_;
  IslandSolver solver_;
  PlanOptions options_;
  std::int64_t number_ = 0;  // of plans that were made
  std::vector<Member> members_;
  std::vector<int> place_of_;  // of each body of the world among the members, or -1
  world::BoundsTree tree_;     // of the members' boxes
  double length_ = 0;
  std::vector<Twist> drift_, last_;        // u, and what free flight adds until the end
  std::vector<Twist> arrivals_;
  std::vector<RigidBody> fast_, path_;     // with velocities w, and y
  std::vector<Track> tracks_;
  std::vector<double> shares_;             // of its path that a body goes
  std::vector<char> planned_, pushed_, changed_;
  std::vector<Row> rows_;
  std::vector<Candidate> candidates_;
  std::vector<Unproved> unproved_;
  std::vector<int> blocked_;
  std::vector<lcp::Contact> contact_list_;
  std::vector<double> allowed_, impulses_;
  double residual_ = 0, correction_ = 0, meeting_ = 0;
  lcp::Status status_ = lcp::Status::limit;
  int solves_ = 0, sweeps_ = 0, checked_ = 0;
};

}  // namespace fc::resting

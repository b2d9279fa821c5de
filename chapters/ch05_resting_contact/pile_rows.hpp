// The rows of a pile's plan: which contact each row stands for, and what it did.
#pragma once

#include <span>
#include <vector>

#include "ch05_resting_contact/gauss_seidel.hpp"
#include "ch05_resting_contact/plan.hpp"

namespace fc::resting {

// The velocities that free flight would give a member at its plan's end.
Twist free_velocities(const Courses& courses, std::size_t member);

// Whether the members have less kinetic energy than if all moved at this speed (m/s).
bool are_slow(std::span<const Member> members, double speed);

class PileRows {
 public:
  PileRows(Contacts& contacts, const Courses& courses, GaussSeidel& gauss_seidel)
      : contacts_(contacts), courses_(courses), gauss_seidel_(&gauss_seidel) {}

  // Adds one row for each contact point of the courses' pairs.
  void start(const world::World& world);
  // Adds what the courses have found since.
  void add_members();
  // Corrects the pair's rows to the gaps that it will have at the end of its paths, and adds a row for each other point
  // that it has there.
  void look_again(const world::World& world, int candidate);
  // An impulse at the end of a path needs a contact there: impulses without one are dropped. Returns how often it
  // swept.
  int drop_what_acts_on_air();
  // Adds to the velocities at the end what those contacts give back that approached faster than rest_speed (m/s).
  void give_back(const world::World& world, double rest_speed, std::vector<RigidBody>& bodies);
  // Stores impulses as guesses for the next plan.
  void remember() const;
  // Reports what kinematic bodies did and, of `all`, each row. swept, bounced: the members at the end, before and after
  // give_back().
  void report(const world::World& world, std::span<const RigidBody> swept, std::span<const RigidBody> bounced,
              bool all, Planned& result) const;
  int count() const { return static_cast<int>(rows_.size()); }

 private:
  struct Row {
    int pair;       // among the candidates
    int place;      // among the points of the pair, or, if `late`, among late_
    int next;       // the next row of the same pair, or -1
    double before;  // m/s: how fast the contact would part after free flight
    bool late;      // found at the end of a path that is not clear
    bool arrives;   // not in contact at the start
  };
  const ContactPoint& point_of(const Row& row) const {
    return row.late ? late_[at(row.place)]
                    : courses_.candidates[at(row.pair)].contacts->points[at(row.place)];
  }
  lcp::Contact contact_of(const world::World& world, const Row& row) const;
  void add_pair(const world::World& world, int candidate);
  void end_pair(int candidate, int first);
  int add_row(const lcp::Contact& contact, int candidate, int place, bool late);

  Contacts& contacts_;
  const Courses& courses_;
  GaussSeidel* gauss_seidel_;
  std::vector<Row> rows_;
  std::vector<int> first_row_;  // of each candidate, or -1
  std::vector<ContactPoint> late_;
  std::vector<Vec3> guesses_;
  std::vector<double> back_;  // N s, of each row
};

}  // namespace fc::resting

// Piles: so many bodies that meet in one frame that nobody could go from one of their events to the next.
#pragma once

#include <memory>
#include "ch05_resting_contact/gauss_seidel.hpp"

#include "ch05_resting_contact/plan.hpp"

namespace fc::resting {

struct PileOptions {
  double frame =
      0;  // s: what comes in faster than a margin in that time gives back what its restitution says
  int sweeps = 16;
  bool settles = false;     // it nearly stands: more, until they agree
  int rounds = 3;           // in which pairs whose paths are not clear are looked at again,
  int path_sweeps = 8;      // with so many sweeps in each
  int visits = 4000;        // of rows, in all sweeps together: more sweeps, if they would be fewer
  bool report_rows = true;  // whether rows are wanted
};

// Plans for piles. There are no events in one: whatever arrives within the plan's time does so at its end, and gives back at
// the end what its restitution says.
//   1. From v + T g, the velocities after free flight, and from u, its mean velocities, sweeps find the end's velocities (no
//      contact closes in by more than what is left of its gap) and the paths' (gaps end as wanted), all rows at once.
//   2. All paths are proved. For pairs whose are not clear the rows are corrected to the gaps at the end as they will be, with
//      the points that the two have there, and paths are swept again.
//   3. A body that is then still in the way of another goes only a share of its path, and keeps that share of its velocity;
//      bodies that push each other keep one share together, since then they move as they would, but slower.
class PilePlanner {
 public:
  PilePlanner(Contacts& contacts, const ContactLaw& law)
      : contacts_(contacts), courses_(contacts, true), gauss_seidel_(law.gauss_seidel()) {}

  Planned make(const world::World& world, std::span<const Member> members, double now, double length,
               const PileOptions& options);

  // Of the last make():
  double lost_impulse() const { return lost_; }  // N s, that shortening took
  int shortened() const { return shortened_; }   // bodies
  bool gains() const { return gains_; }  // whether it adds more energy than is small beside what there is
  // Kinematic bodies (by their numbers in the world) that went into what could not give way.
  const std::vector<int>& blocked() const { return blocked_; }
  double residual() const { return gauss_seidel_->residual(); }
  int sweeps() const { return swept_; }
  int checked() const { return courses_.checked(); }
  int rows() const { return static_cast<int>(rows_.size()); }
  double smallest_gap() const;  // m, of bodies in contact at the start, certified

 private:
  struct Row {
    int pair;       // among the candidates
    int place;      // among the points of the pair, or, if `late`, among late_
    int next;       // row of the same pair, or -1
    double before;  // m/s: how fast the contact parts after free flight
    bool late;      // found at the end of a path that is not clear
    bool arrives;   // not in contact at the start
  };
  const ContactPoint& point_of(const Row& row) const {
    return row.late ? late_[at(row.place)]
                    : courses_.candidates[at(row.pair)].contacts->points[at(row.place)];
  }
  lcp::Contact contact_of(const world::World& world, const Row& row) const;
  Twist free_velocities(std::size_t i) const;
  void add_bodies();
  void end_pair(int candidate, int first);
  void add_pair(const world::World& world, int candidate);
  int add_row(const lcp::Contact& contact, int candidate, int place, bool late);
  void find_paths(const world::World& world);
  void look_again(const world::World& world, int candidate);
  void drop_what_acts_on_air();
  void remember() const;
  void give_back(const world::World& world, std::vector<RigidBody>& bodies);
  void report_rows(const world::World& world, std::span<const RigidBody> swept,
                   std::span<const RigidBody> bounced, Planned& result) const;
  Planned take(const world::World& world);

  Contacts& contacts_;
  Courses courses_;
  std::unique_ptr<GaussSeidel> gauss_seidel_;
  PileOptions options_;
  std::vector<Row> rows_;
  std::vector<int> first_row_;  // of each candidate, or -1
  std::vector<ContactPoint> late_;
  std::vector<Twist> velocities_, paths_;  // of each member, at the end
  std::vector<double> shares_;             // of its path that a member goes
  std::vector<Vec3> guesses_;
  std::vector<double> back_;  // N s, of each row
  std::vector<int> blocked_;
  double lost_ = 0;
  bool gains_ = false;
  int shortened_ = 0, swept_ = 0;
};

}  // namespace fc::resting

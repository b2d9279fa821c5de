// Piles: bodies that meet so often in one frame that going from event to event would take too long.
#pragma once

#include <algorithm>
#include <memory>

#include "ch05_resting_contact/pile_rows.hpp"

namespace fc::resting {

struct PileOptions {
  double frame =
      0;  // s: what comes in faster than a margin in that time gives back what its restitution says
  int sweeps = 16;
  int rounds = 3;                 // in which pairs whose paths are not clear are looked at again,
  int path_sweeps = 8;            // sweeps in each of these rounds
  int visits = 4000;              // of rows, in all sweeps together: more sweeps, if they would be fewer
  int settling_visits = 150'000;  // of rows at most, if it nearly stands and the residual is not small
  bool report_rows = true;        // whether rows are wanted
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
      : contacts_(contacts),
        courses_(contacts, true),
        gauss_seidel_(law.gauss_seidel()),
        rows_(contacts, courses_, *gauss_seidel_) {}

  Planned make(const world::World& world, std::span<const Member> members, double now, double length,
               const PileOptions& options);

  // What the last make() did:
  double lost_impulse() const { return lost_; }  // N s, that shortening took
  int shortened() const { return shortened_; }   // bodies
  bool gains() const { return gains_; }  // whether it adds more energy than is small beside what there is
  // Kinematic bodies (by their numbers in the world) that went into what could not give way.
  const std::vector<int>& blocked() const { return blocked_; }
  double residual() const { return gauss_seidel_->residual(); }
  int sweeps() const { return swept_; }
  int checked() const { return courses_.checked(); }
  int rows() const { return rows_.count(); }
  double smallest_gap() const;  // m, of bodies in contact at the start, certified

 private:
  int sweeps(int least) const { return std::max(least, options_.visits / (1 + rows())); }
  void find_paths(const world::World& world);
  Planned take(const world::World& world);

  Contacts& contacts_;
  Courses courses_;
  std::unique_ptr<GaussSeidel> gauss_seidel_;
  PileRows rows_;
  PileOptions options_;
  std::vector<Twist> velocities_, paths_;  // of each member, at the end
  std::vector<double> shares_;             // of its path that a member goes
  std::vector<int> blocked_;
  double lost_ = 0;
  bool gains_ = false;
  int shortened_ = 0, swept_ = 0;
};

}  // namespace fc::resting

// Piles: groups of bodies that meet too often in one frame to be stepped from event to event.
#pragma once

#include <algorithm>
#include <memory>

#include "ch05_resting_contact/pile_rows.hpp"
#include "ch05_resting_contact/stage_times.hpp"

namespace fc::resting {

struct PileOptions {
  double frame =
      0;  // s: a contact that closes by more than a margin in this time gives back what its restitution says
  int sweeps = 16;
  int rounds = 3;       // in which pairs whose paths are not clear are examined again,
  int path_sweeps = 8;  // sweeps in each of these rounds
  int visits = 4000;    // the least number of row visits in all sweeps: small piles get more sweeps
  int settling_visits =
      150'000;              // the most row visits, if the pile nearly stands and the residual is not small
  bool report_rows = true;  // whether the plan lists its rows
};

// Plans for piles. A pile has no events: what arrives within the plan's time arrives at its end, and gives back there
// what its restitution says.
//   1. From v + T g, the velocities after free flight, and from u, its mean velocities, sweeps find the velocities at the end (no
//      contact closes in by more than the rest of its gap) and those of the paths (gaps end as wanted), all rows at once.
//   2. All paths are proved. For a pair whose paths are not clear, the rows are corrected to the gaps that it will have at the
//      end, with the points that it has there, and the paths are swept again.
//   3. A body that is then still in another's way goes only a share of its path, and keeps that share of its velocity. Bodies
//      that push each other get one common share: then they move as they would, but more slowly.
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
  bool gains() const { return gains_; }  // whether it adds a considerable share to the energy that there is
  // Kinematic bodies (by their numbers in the world) that ran into what cannot give way.
  const std::vector<int>& blocked() const { return blocked_; }
  double residual() const { return gauss_seidel_->residual(); }
  int sweeps() const { return swept_; }
  int checked() const { return courses_.checked(); }
  const StageTimes& times() const { return times_; }
  int rows() const { return rows_.count(); }
  double smallest_gap() const;  // m, of bodies in contact at the start, certified

 private:
  int sweeps(int least) const { return std::max(least, options_.visits / (1 + rows())); }
  void search(const world::World& world);
  int sweep(int count);
  void find_paths(const world::World& world);
  void shorten(const world::World& world);
  Planned take(const world::World& world);

  Contacts& contacts_;
  Courses courses_;
  std::unique_ptr<GaussSeidel> gauss_seidel_;
  PileRows rows_;
  PileOptions options_;
  std::vector<Twist> velocities_, paths_;  // of each member, at the end
  std::vector<double> shares_;             // the share of its path that a member goes
  std::vector<int> blocked_;
  double lost_ = 0;
  StageTimes times_;
  bool gains_ = false;
  int shortened_ = 0, swept_ = 0;
};

}  // namespace fc::resting

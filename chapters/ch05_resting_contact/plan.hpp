// Makes plans: how the bodies of an island go on together for some time, with the contacts that last.
#pragma once

#include <memory>

#include "ch05_resting_contact/plan_rows.hpp"
#include "ch05_resting_contact/planned.hpp"

namespace fc::resting {

// A plan is halved where its paths are not clear, down to this part of a frame.
constexpr double kShortest = 1.0 / 4096;
// A path is clear if its gap stays above this part of the margin, or half of what it was.
constexpr double kFloor = 1.0 / 64;
// A share of the margin. Two bodies that approach fast, and bounce, stop at half of this gap, as in chapter 4.
constexpr double kStop = 0.25;
// A plan that would leave less than this share of the rest of the frame takes all of it.
constexpr double kNearlyAll = 0.75;

// Pushes and corrects (see PlanRows), and proves the paths, which are straight, with constant spin. What an unproved
// path meets becomes a row, or ends the plan; else a shorter plan is made. This is the first half of RATTLE (Andersen
// 1983), with inequalities. The second half, after which no contact closes, is the impact law at the next instant.
class PlanMaker {
 public:
  PlanMaker(Contacts& contacts, ContactLaw& law, std::size_t bodies)
      : contacts_(contacts),
        courses_(contacts, false),
        rows_(courses_, law, contacts.margin()),
        lengths_(bodies, std::numeric_limits<double>::infinity()),
        changes_(bodies, 0) {}

  void next_frame() { std::fill(changes_.begin(), changes_.end(), 0); }
  // A plan for the bodies of the island that are in contact, from `now` on (s in a frame of dt seconds), for as long as
  // their paths can be proved, at most to the frame's end; null if there is none. The forces found are guesses for the
  // next plan. Its solutions are added to the report. Throws if the scene's solver fails.
  std::shared_ptr<const Planned> make(const world::World& world, const Island& island, double now, double dt,
                                      const IslandOptions& options, world::StepReport& report);
  // Of the last make():
  double length() const { return courses_.length(); }  // s
  int checked() const { return checked_; }             // paths that it tried to prove
  const StageTimes& times() const { return rows_.times; }

 private:
  PlanResult try_length(const world::World& world, const Island& island, double now, double length,
                        bool may_change);
  bool gains() const;
  bool add_rows_of(const world::World& world, int candidate);
  double arrival(const PlanRow& row) const;
  void remember() const;
  Planned take();

  Contacts& contacts_;
  Courses courses_;
  PlanRows rows_;
  IslandOptions options_;
  double rest_speed_ = 0;  // m/s: a faster approach ends the plan when the contact is reached
  double meeting_ = 0;     // s: when the first two bodies that bounce meet, or impulses have to change
  int checked_ = 0;
  std::vector<double> lengths_;  // s, the most for each body's next plan
  std::vector<int> changes_;  // of its plans in this frame: those that ended because impulses had to change
};

}  // namespace fc::resting

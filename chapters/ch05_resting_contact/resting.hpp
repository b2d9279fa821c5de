// Chapter 5's planner: bodies in contact follow plans; all others fly, as in chapter 4.
#pragma once

#include <limits>
#include <memory>

#include "ch05_resting_contact/envelope.hpp"
#include "ch05_resting_contact/kinematic_watch.hpp"
#include "ch05_resting_contact/pile.hpp"
#include "ch05_resting_contact/pile_list.hpp"
#include "ch05_resting_contact/planned.hpp"
#include "ch05_resting_contact/rest_records.hpp"
#include "ch05_resting_contact/standing.hpp"

namespace fc::resting {

// What a frame did beyond chapter 4's report.
struct RestReport {
  world::StepReport step;
  int resting = 0;  // impulses of contacts that last: one for each contact and plan
  int plans = 0;
  std::int64_t searched = 0;                                      // pairs whose contacts were searched anew
  std::int64_t checked = 0;                                       // paths of pairs that were to be proved
  double smallest_gap = std::numeric_limits<double>::infinity();  // m, of bodies in contact, certified
  int largest_island = 0;                                         // contact points
  int sweeps = 0;                                                 // of Gauss-Seidel, in piles
  double correction = 0;  // m, the most that a point of a body was moved to correct gaps
  // J, what bodies in contact gained beyond the work of kinematic bodies: by corrections of positions, and by the
  // plans' error, which is of second order
  double correction_energy = 0;
  double tangential_work = 0;  // J, of impulses along the surfaces
  int shortened = 0;           // bodies of piles whose paths were shortened
  double lost_impulse = 0;     // N s, the momentum that shortening took
  // J, for an account of energies. What impacts took along the normals; and what plans, with the instants at their ends, took or
  // added, beyond the works of friction and of kinematic bodies, summed over the plans that end together.
  double impact_energy = 0, plan_loss = 0, plan_gain = 0;
  StageTimes times = {};
  std::vector<Clash> clashes = {};  // of kinematic bodies, first reported in this frame; times in the frame
};

struct RestOptions {
  double most_work = 2e5;         // see ContactLaw::event_work(): more makes a pile
  int most_meetings = 256;        // a body that meets others more often in one frame joins a pile, too
  int sweeps = 16;                // of a pile's rows,
  int visits = 4000;              // with at least this many row visits;
  int settling_visits = 150'000;  // and at most this many, if it nearly stands, until its residual is small
  IslandOptions solver = {};
};

class Resting : public world::Planner {
 public:
  // Sets the world's rest gap. Throws as envelope_of().
  Resting(const Scene& scene, world::World& world, double dt, const RestOptions& options = {},
          std::unique_ptr<ContactLaw> law = {});  // none: a NormalLaw

  // One frame of dt seconds (that of the constructor).
  RestReport step(world::World& world, const world::Listeners& listeners = {});
  double envelope() const { return contacts_.margin(); }
  // Between frames, for a world of the same bodies and perhaps more, with the same tolerance: begins with the contacts that are
  // known already, if the envelope is the same; and if all rules are the same, with the plans of islands that stand.
  void take_over(const Resting& before, bool same_rules);

  std::vector<int> begin(world::World& world, double dt, world::StepReport& report,
                         const world::Listeners& listeners) override;
  double next_end() const override;
  std::vector<int> end_plans(world::World& world, double now, world::StepReport& report,
                             const world::Listeners& listeners) override;
  std::vector<int> meet(world::World& world, int a, int b, double now, world::StepReport& report,
                        const world::Listeners& listeners) override;

 private:
  std::vector<int> go_on(Instant instant);
  bool go_on(Instant& instant, Island& island);
  void go_on(Instant& instant, PileList::Pile& pile);
  Island grow(const world::World& world, int body);
  bool is_pile(const Instant& instant, const Island& island);
  double stand(Instant& instant, std::span<Member> members);
  void set_motions(Instant& instant, std::span<const Member> members, double before, double work);
  bool resolve(Instant& instant, Island& island);
  bool plan(Instant& instant, const Island& island);
  bool start(Instant& instant, const std::shared_ptr<const Planned>& planned, double end);

  RestOptions options_;
  double frame_, dt_;  // s, of a frame, and of the part of it being stepped
  Contacts contacts_;
  IslandFinder islands_;
  std::unique_ptr<ContactLaw> law_;
  PlanMaker maker_;
  PilePlanner pile_planner_;
  PileList piles_;
  RunningPlans plans_;
  Standing standing_;
  KinematicWatch watch_;
  std::vector<int> meetings_;   // of each body, in this frame
  std::vector<double> energy_;  // J, of each body when its motion began, in this frame
  RestReport report_;
  RestRecords records_;
};

}  // namespace fc::resting

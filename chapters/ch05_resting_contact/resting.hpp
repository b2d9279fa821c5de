// Chapter 5's planner: bodies in contact go by plans; all else flies, as in chapter 4.
#pragma once

#include <limits>
#include <unordered_map>

#include "ch05_resting_contact/envelope.hpp"
#include "ch05_resting_contact/impact_law.hpp"
#include "ch05_resting_contact/plan.hpp"

namespace fc::resting {

// What a frame did beyond chapter 4's report.
struct RestReport {
  world::StepReport step;
  int resting = 0;                  // contacts that last, and got an impulse
  int plans = 0;
  std::int64_t searched = 0;        // pairs whose contacts were searched anew
  std::int64_t checked = 0;         // paths of pairs that were to be proved
  double smallest_gap = std::numeric_limits<double>::infinity();  // m, of bodies in contact, certified
  int largest_island = 0;           // contact points
  int sweeps = 0;                   // of Gauss-Seidel
  double correction = 0;            // m, the largest that a body's point was moved to put gaps right
  double correction_energy = 0;     // J, that bodies in contact gained beyond what kinematic bodies did: by corrections of
                                    // positions, and by the plans' error, which is of second order
  int shortened = 0;                // bodies of piles whose paths were shortened
  double lost_impulse = 0;          // N s, the momentum that this took
};

struct RestOptions {
  int crowd = 100;  // contact points of one island, from which on what arrives in it is no event: see IslandFinder
  int pile = 400;   // and from which on it is a pile: solved by sweeps, its paths shortened
  IslandOptions small = {.most_dense_rows = 1000, .accepted = 1e-3};
};

class Resting : public world::Planner {
 public:
  // Sets the world's reserve. Throws as envelope_of().
  Resting(const Scene& scene, world::World& world, double dt, const RestOptions& options = {});

  // One frame of dt seconds (that of the constructor).
  RestReport step(world::World& world, const world::Listeners& listeners = {});
  double envelope() const { return contacts_.margin(); }

  std::vector<int> begin(world::World& world, double dt, world::StepReport& report,
                         const world::Listeners& listeners) override;
  double next_end() const override;
  std::vector<int> end_plans(world::World& world, double now, world::StepReport& report,
                             const world::Listeners& listeners) override;
  std::vector<int> meet(world::World& world, int a, int b, double now, world::StepReport& report,
                        const world::Listeners& listeners) override;

 private:
  struct Running {  // a plan
    bool runs = false;
    double start = 0, end = 0;
    std::vector<int> bodies;
    std::vector<Twist> arrivals;  // of each: what its velocities get if the plan comes to its end
    std::vector<PlannedRow> rows;
    double work = 0;  // J, that kinematic bodies do
  };
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  void finish_plan_of(world::World& world, int body, double now, std::vector<int>& bodies,
                      world::StepReport& report);
  std::vector<int> go_on(world::World& world, std::vector<int> bodies, double now, world::StepReport& report,
                         const world::Listeners& listeners);
  double told_at(double now) const;
  void report_rest(const world::ImpactRecord& record, std::uint64_t key);
  void resolve(world::World& world, Island& island, double now, world::StepReport& report,
               const world::Listeners& listeners);
  void plan(world::World& world, Island& island, double now, world::StepReport& report);
  void start_plan(world::World& world, const Island& island, double now, double length);
  bool stop_kinematic(world::World& world, Island& island, double now, world::StepReport& report);
  void stop(world::World& world, int kinematic, double now, world::StepReport& report);
  void find_crowds(const world::World& world, const std::vector<int>& bodies);
  PlanOptions options_for(const Island& island) const;
  void come_to_rest(const world::World& world, Member& member) const;
  double energy_of(const world::World& world, int body) const;
  void wake(world::World& world, Island& island, world::StepReport& report);
  void fall_asleep(world::World& world, const Island& island, world::StepReport& report);

  Contacts contacts_;
  IslandFinder islands_;
  PlanMaker maker_;
  IslandSolver solver_;
  RestOptions options_;
  double frame_, dt_;  // s, of a frame, and of the part of it at hand
  std::vector<Running> plans_;
  std::vector<int> free_plans_;
  std::vector<int> meetings_;      // of each body, in this frame
  std::vector<double> try_length_;  // s, of each body's next plan at most
  std::vector<char> crowded_;      // of each body, in this frame
  std::vector<double> energy_;     // J, of each body when it got its course, in this frame
  std::vector<double> still_;      // s, for how long it has been carried, and slow
  RestReport report_;
  std::vector<world::ImpactRecord> rests_;  // of contacts that last, in this frame
  std::vector<std::uint64_t> rest_keys_;    // their points' keys
  std::unordered_map<std::uint64_t, std::size_t> rest_of_;  // the first of them of two bodies
};

}  // namespace fc::resting

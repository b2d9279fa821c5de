// Chapter 5's step in its clear form: the same plans as resting.hpp, found in the plainest way, for convex bodies and
// with gravity alone. It runs on the pieces of exercises 3.6 and 5.7; with world::put_on_pieces() chapter 4's loop runs
// on its own pieces, too.
#pragma once

#include <vector>

#include "ch05_resting_contact/clear/pieces.hpp"
#include "ch05_resting_contact/island.hpp"

namespace fc::resting {

struct ClearReport {
  world::StepReport step;
  int plans = 0, halved = 0;     // plans that were followed; lengths for which no plan was proved
  double correction_energy = 0;  // J, the potential energy that corrections of positions added
};

class ClearPlan;

class ClearResting : public world::Planner {
 public:
  // Sets the world's rest gap. Throws as envelope_of() does, and InputError for what it does not handle: meshes, drag,
  // sleep, sensors, free rotation, other solvers.
  ClearResting(const Scene& scene, world::World& world, double dt, const clear::Pieces& pieces = {});

  // One frame of dt seconds (the constructor's). Throws SceneFailure where no impulses are found, or no plan is short
  // enough to be proved.
  ClearReport step(world::World& world, const world::Listeners& listeners = {});
  double envelope() const { return contacts_.margin(); }

  std::vector<int> begin(world::World& world, double dt, world::StepReport& report,
                         const world::Listeners& listeners) override;
  double next_end() const override;
  std::vector<int> end_plans(world::World& world, double now, world::StepReport& report,
                             const world::Listeners& listeners) override;
  std::vector<int> meet(world::World& world, int a, int b, double now, world::StepReport& report,
                        const world::Listeners& listeners) override;

 private:
  struct Plan {
    double start, end;  // s in the frame
    bool runs = true;
    std::vector<int> bodies = {};
    std::vector<world::ImpactRecord> records = {};  // of its impulses, over all of its time
    double lift = 0;                                // J, the work of its corrections against gravity
  };
  std::vector<int> go_on(world::World& world, std::vector<int> bodies, double now);
  void end_plan_of(world::World& world, int body, double now, std::vector<int>& bodies);
  void stop_what_closes(const world::World& world, Island& island, double now);
  void plan(world::World& world, const Island& island, double now);
  void follow(world::World& world, const ClearPlan& made);
  void report_impulses(const std::vector<world::ImpactRecord>& records, double share);

  clear::RestingStepFunction* resting_step_;  // the pieces
  clear::LcpFunction solve_lcp_;
  Contacts contacts_;
  IslandFinder islands_;
  std::vector<int> no_piles_;  // of each body: -1, since it is in no pile
  double frame_, dt_;          // s, of a frame, and of the part of it being stepped
  std::vector<Plan> plans_;    // of this frame
  ClearReport report_;
  const world::Listeners* listeners_ = nullptr;
};

}  // namespace fc::resting

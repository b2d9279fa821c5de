// Chapter 5's step: contacts that last are solved at the frame's start, everything else happens as in chapter
// 4, and gaps are put right by positions alone.
#pragma once

#include "ch05_resting_contact/envelope.hpp"
#include "ch05_resting_contact/island_solver.hpp"
#include "ch05_resting_contact/islands.hpp"
#include "ch05_resting_contact/steering.hpp"

namespace fc::resting {

// What a frame did beyond chapter 4's report.
struct RestReport {
  world::StepReport step;  // all of the frame, resting contacts included
  int shell_contacts = 0;
  std::int64_t searched = 0;  // pairs whose contacts were searched anew
  int largest_island = 0;     // rows
  int sweeps = 0;             // of Gauss-Seidel, all islands
  double smallest_gap = 0;    // m, in the shell, at the frame's start; infinite if it is empty
  Steering steering;
};

// Keeps what lasts from frame to frame.
class Resting {
 public:
  // Sets the world's rest_speed and touch. Throws as envelope_of().
  Resting(const Scene& scene, world::World& world, double dt);

  // One frame of dt seconds. Guarantees of chapter 4's step hold: no gap ever becomes zero. A pair within the
  // envelope whose bodies close in slower than the envelope's width in a frame is no event: it gets an
  // impulse at the frame's start so that at its end, to first order in dt, its gap is at least half the
  // envelope, or what it was. Throws NumericalFailure if an island cannot be solved.
  RestReport step(world::World& world, const world::Listeners& listeners = {});

  double envelope() const { return shell_.envelope(); }

 private:
  void solve_islands(world::World& world, const world::Listeners& listeners, RestReport& report);
  void solve(world::World& world, const std::vector<int>& members, Island& island,
             const world::Listeners& listeners, RestReport& report);
  void add(const world::StepReport& events, RestReport& report) const;

  Shell shell_;
  IslandSolver solver_;
  double dt_;
};

}  // namespace fc::resting

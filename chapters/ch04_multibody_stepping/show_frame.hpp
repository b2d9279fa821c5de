// The account of one frame of chapter 4, from all chapters that it uses.
#pragma once

#include <cstdint>

#include "ch03_impulse_lcp/show_impulses.hpp"
#include "ch04_multibody_stepping/show_events.hpp"

namespace fc::world {

// The account of the frame that begins with the world, which is stepped. before: frames that came before; t0: s, its start.
// Worked out anew from where the bodies stand: the step may remember more. May throw NumericalFailure, as the step.
algorithm::Document show_frame(const Scene& scene, World& world, std::int64_t before, double t0);

// The parts of chapters 1 and 2: how pairs that met were found; if none met, the nearest pair.
class ShownSearches {
 public:
  // At the frame's start: looks for the pair that is shown if nothing meets.
  ShownSearches(const World& world, double dt);
  void add_parts(const World& world, const FrameWatch& watch, double t0, algorithm::Document& document) const;

 private:
  std::vector<SeenSearch> searches(const World& world, const FrameWatch& watch) const;
  SeenSearch nearest_;  // a == b: there is none
};

// m: the length of the longest arrow of these bodies.
double arrow_length(const World& world, const std::vector<int>& bodies);

}  // namespace fc::world

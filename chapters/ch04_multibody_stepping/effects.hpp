// The effects of a scene: what it asks for, or implies, decided once. An effect that is off takes no part in a step.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/program.hpp"
#include "common/scene.hpp"
#include "common/types.hpp"

namespace fc::world {

// Which part of the pipeline each effect changes:
//   Motion      gravity, drag, gyroscopic, kinematic, path: the motions that a body may have between two events
//   Gap rule    sensor: its pairs are reported, not stopped; sleep: its pairs are not queried
//   Impact law  restitution: the right-hand side; rotation: the rows' angular parts; fixed: zeros in the inverse masses
struct Effects {
  std::optional<Vec3> gravity;     // m/s^2
  std::optional<DragSpec> drag;    // 1/s
  std::optional<SleepSpec> sleep;  // s, m/s
  bool gyroscopic = false;
  bool rotation = true;  // derived: off if all bodies that move are balls, which no impulse turns
  bool restitution = false;
  bool kinematic = false;
  bool sensors = false;
  bool paths = false;   // a kinematic body follows a path
  bool guided = false;  // a body has fixed degrees of freedom
  // The study changes these two, to measure what they are worth.
  bool swept = true;  // pairs whose swept boxes are apart are not queried
  bool arms = false;  // the zero lever arms of balls are computed, too
};

Effects effects_of(const Scene& scene);

// For --explain: every effect that is on, why, and what it adds; and what is derived.
std::vector<Effect> explain(const Scene& scene);

}  // namespace fc::world

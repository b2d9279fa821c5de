// The effects of a scene: what it asks for, or implies, decided once. An effect that is off leaves nothing
// behind.
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
//   Gap rule    sensor: its pairs are reported, and not stopped; sleep: its pairs are not queried
//   Impact law  restitution: the right-hand side; rotation: the rows' angular parts; fixed: zeros in the inverse masses
struct Effects {
  std::optional<Vec3> gravity;     // m/s^2
  std::optional<DragSpec> drag;    // 1/s
  std::optional<SleepSpec> sleep;  // s, m/s
  bool gyroscopic = false;
  bool rotation =
      true;  // derived: off if no body that moves can be turned by an impulse, or changes by turning
  bool restitution = false;
  bool kinematic = false;
  bool sensors = false;
  bool paths = false;   // a kinematic body follows one
  bool guided = false;  // a body lacks degrees of freedom
  // Always on; the study turns them off, to measure what they are worth.
  bool swept = true;  // pairs whose swept boxes are apart are not queried
  bool arms = false;  // the zero lever arms of balls are computed, too
};

Effects effects_of(const Scene& scene);

// For --explain: every effect that is on, why, and what it adds; and what is derived.
std::vector<Effect> explain(const Scene& scene);

}  // namespace fc::world

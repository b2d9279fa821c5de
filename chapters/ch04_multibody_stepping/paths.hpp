// Kinematic bodies that go through given poses, and frames that are divided where one of them begins a new motion.
#pragma once

#include <vector>

#include "common/rigid_body.hpp"
#include "common/scene.hpp"
#include "common/shape.hpp"

namespace fc::world {

struct World;
struct StepReport;
struct Listeners;

// Poses at given times. Between two of them the centre of mass moves straight and the body turns with constant spin, by
// the shorter rotation; before the first and after the last it is at rest.
class Path {
 public:
  // rows: at least one, times ascending; their positions are those of the shape's frame.
  Path(const std::vector<PathRow>& rows, const Shape& shape);

  // The body's pose at a time, and the velocities with which it goes on; a row within the next `soon` seconds counts as
  // reached.
  RigidBody at(double time, double soon) const;
  // The time of the first row later than this, s; infinite if there is none.
  double next_after(double time) const;

 private:
  std::vector<PathRow> rows_;  // positions: of the centre of mass
};

// Gives every body with a path its motion for the next dt seconds (during which no row comes), except for frozen
// bodies: they stand still, and go on from there, later by that time.
void follow_paths(World& world, double dt);

// For how long, of the next dt seconds, all bodies with a path keep their motions; dt if no row comes within. A row
// counts as within if it is farther from either end than a part in 10^12 of dt.
double until_next_row(const World& world, double dt);

// The same listeners, for a part of a frame that begins at `start` (s in the frame).
Listeners from(double start, const Listeners& listeners);

// Adds what a part of a frame did to what the frame did.
void add(const StepReport& part, StepReport& all);

}  // namespace fc::world

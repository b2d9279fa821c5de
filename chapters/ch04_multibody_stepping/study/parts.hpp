// The measurements behind chapter 4's figures and tables (the executable ch04_study). Each function writes its own
// tables. Columns that end in _ns hold times of this machine, or what follows from them; all others are the same in
// every run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ch04_multibody_stepping/world.hpp"

namespace fc::world {

struct StudyOptions {
  std::filesystem::path out;
  int bodies = 3000;   // of the largest gas, >= 100
  int repeats = 5;     // of each run, for the median of its times
  bool quiet = false;  // no progress
};

void study_switches(const StudyOptions& options);  // switches.csv
void study_growth(const StudyOptions& options);    // growth.csv
void study_accuracy(const StudyOptions& options);  // bounces.csv, trajectories.csv

// One step of Moreau's time stepping: a ball's height above a floor (m) and its speed (m/s, up).
void moreau_step(double dt, double gravity, double restitution, double& height, double& speed);

// The shape of the bodies of a gas.
enum class Kind { ball, block, hull };

// A gas: bodies of about 1 m in a closed room, of which they fill about an eighth. Elastic; on a grid at the start,
// with random velocities of about 3 m/s, and spins of about 2 rad/s unless they are balls. Six static walls come first.
Scene gas(Kind kind, int bodies, std::uint64_t seed);

// The results of a run of several frames.
struct Run {
  StepReport sum;           // of all frames: counts added, worst values kept
  double energy_drift = 0;  // relative, |last / first - 1|
  std::vector<double> ns;   // of each frame
  double total_ns() const;
};
Run run_frames(World& world, double dt, int frames);

}  // namespace fc::world

// The measurements behind chapter 5's figures and tables (the executable ch05_study). Columns that end in _ns
// hold times of this machine; all others are the same in every run.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

#include "ch05_resting_contact/resting.hpp"

namespace fc::resting {

struct StudyOptions {
  std::filesystem::path out;
  int repeats = 3;     // of each run: the shortest of its times counts, since disturbances only add to it
  bool quiet = false;  // no progress
};

void study_solvers(const StudyOptions& options);  // forces.csv, heap.csv
void study_knobs(const StudyOptions& options);    // envelope.csv, step.csv
void study_methods(const StudyOptions& options);  // methods.csv, weights.csv, histories.csv, ball.csv

constexpr double kGravity = 9.81;     // m/s^2
constexpr double kFrame = 1.0 / 60;   // s
constexpr double kEnvelope = 5e-4;    // m
constexpr double kRestitution = 0.5;  // of the ball; nothing else bounces
constexpr double kDrop = 1;           // m, the height from which the ball falls
constexpr double kSlope = M_PI / 6;   // rad
constexpr int kBoxes = 10;            // of a stack

// Body 0 is the floor. All with an envelope of kEnvelope.
Scene ball_scene();
// kBoxes boxes of 1 m and 1 kg, one above the other, `apart` (m) from each other.
Scene stack_scene(double apart);
// One box on a slope: gravity is inclined, the floor is not.
Scene slope_scene();
// Boxes of half a metre that fall into a pit. Five static bodies come first.
Scene heap_scene(int side, int layers);

// For the ball: its height above the floor at time t, and when its bounces have ended.
double ball_height(double t);
double zeno_time();

enum class Method { events, envelope, moreau };
const char* name(Method method);
inline std::ostream& operator<<(std::ostream& out, Method method) {
  return out << name(method);
}

// A scene, and how it is run.
struct Setting {
  Scene scene;
  double seconds = 0;
  double dt = kFrame;
  Method method = Method::envelope;
  RestOptions rest = {};
};

// What one frame did.
struct Frame {
  double t = 0;     // s, at its end
  double lost = 0;  // s
  double gap = 0;   // m, the smallest at its end; negative: an overlap. Infinite if nothing is near
  double residual = 0;
  std::vector<double> push;  // N s, the impulses at contacts whose lower number is this body
};

// The results of a run.
struct Run {
  std::int64_t rows = 0, queries = 0, sweeps = 0, solves = 0;
  std::int64_t shortened = 0;  // paths of bodies
  double lost = 0, corrected = 0,
         lost_impulse = 0;  // s; J, added by corrections; N s, taken by shortened paths
  double mean_residual = 0, worst_residual = 0;
  double gap = 0;                          // m, the smallest at the end of a frame, if it was measured
  std::vector<double> ns = {};             // of each repeat
  double second_ns(double seconds) const;  // the shortest, for one simulated second
};

// Builds the world, and runs it `repeats` times; reports each frame of the first run to `look`. Gaps of all methods are
// measured by Facing, which needs faces that lie over each other: it is not for heaps.
using Look = std::function<void(const world::World&, const Frame&)>;
Run run(const Setting& setting, int repeats, const Look& look = {});

struct BallResult {
  Run run;
  double height_error = 0;  // m, the worst at a frame's end
  double place_error = 0;   // m, at the end
  double rest_error = 0;  // s, how late it comes to rest, compared with closed form; known to within a frame
  double energy_error = 0;  // J, at the end
};
struct SlopeResult {
  Run run;
  double way_error = 0;     // m, ahead of closed form after two seconds
  double drift = 0;         // m, across the slope, in the second one
  double energy_error = 0;  // J, at the end, against closed form
};
struct StackResult {
  Run run;
  double first_error = 0;   // force_error() of the first frame
  double force_error = 0;   // the worst of the third second
  double drift = 0;         // m, of a box in the third second
  double place_error = 0;   // m, at the end: how far a box is from where it would just touch
  double energy_error = 0;  // J, at the end, against boxes that just touch
};
// Two seconds of the ball and the slope, three of the stack.
BallResult measure_ball(Setting setting, int repeats, const Look& look = {});
SlopeResult measure_slope(Setting setting, int repeats, const Look& look = {});
StackResult measure_stack(Setting setting, int repeats, const Look& look = {});
double energy_of(const world::World& world);  // J, kinetic and potential

// The largest |F / W - 1|, where F is the force under a level of a stack in this frame and W the weight above it.
double force_error(const Frame& frame, int boxes, double dt);

}  // namespace fc::resting

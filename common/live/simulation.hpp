// What a page in the browser sees of a running scene, and what it can do to it: plain data, and one interface that a
// chapter implements. The server, which knows nothing of physics, is on the one side of it, the chapter on the other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/errors.hpp"
#include "common/types.hpp"

namespace fc::live {

struct Pose {
  Vec3 position = Vec3::Zero();         // m, of the centre of mass
  Quat orientation = Quat::Identity();  // from the shape's axes to the world's
};

struct ContactMark {
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  // m, world; unit, from A to B
  Vec3 impulse = Vec3::Zero();                       // N s, world, on B, in the frame
  int body_a = 0, body_b = 0;
  bool rests = false;  // it lasts; else an impact
};

struct EffectState {
  std::string name;  // as --explain calls it: "gravity"
  bool on = false;
  bool can_switch = false;  // by the command set; see Simulation::set()
  // The scene key that switches it, with the value for on: "gravity=[0, 0, -9.81]"; may be empty.
  std::string key;
  std::string why;   // "declared at line 7", or "not asked for by this scene"
  std::string adds;  // what it adds to the pipeline
  double ms = 0;     // what it costs in a frame now, if that is measured
};

// A scene key that the page offers as a knob.
struct Knob {
  std::string key, unit, value, meaning;  // "ccd.tolerance", "m", "1e-6", one sentence
  double low = 0, high = 0;               // of a number; low > 0: the page's slider is logarithmic
  std::vector<std::string> choices;       // of a word
  bool restarts = false;                  // setting it begins the scene again
};

// The simulation after a frame. Energies in J; those of the account are sums since the start.
struct Snapshot {
  std::int64_t frame = 0;
  double t = 0;   // s, simulated
  double dt = 0;  // s, of a frame
  std::vector<Pose> poses;
  std::vector<ContactMark> contacts;
  // ms in each stage of the last frame ("ccd_ms", "lcp_ms", …). Their sum is step_ms.
  std::vector<std::pair<std::string, double>> stages;
  double step_ms = 0;
  double energy = 0, kinetic = 0, potential = 0;  // J
  // Since the start, in J: "impacts", "friction", "corrections", "hand", …
  std::vector<std::pair<std::string, double>> account;
  double min_gap = 0;    // m, the smallest certified gap of the last frame; infinite if there is none
  double lost_time = 0;  // s, in the last frame
  double residual = 0;   // of the solver, in the last frame
  std::vector<std::string> warnings;                           // the last few lines, the newest last
  int grabbed = -1;                                            // body, or -1
  Vec3 grab_point = Vec3::Zero(), grab_target = Vec3::Zero();  // m, world
};

// How a command went.
struct Answer {
  std::string text;        // one line for people; of save, the scene file
  bool restarted = false;  // the scene began again
  bool reshaped = false;   // with other shapes, or other bodies
  bool rebuilt = false;    // the pipeline was built anew, from the present state
  double ms = 0;           // how long that took
};

// A scene that runs. One thread calls all of this. Commands throw InputError with one line for what they refuse, and then
// nothing has changed. step() may throw NumericalFailure: then the const functions, reset() and set() stay possible.
class Simulation {
 public:
  virtual ~Simulation() = default;
  virtual std::string title() const = 0;
  // Shapes, bodies and levels as a binary glTF file, in the poses of now (see MOTION.md). Anew after each change of geometry().
  virtual std::string glb() const = 0;
  // Counts up when bodies or shapes are added or removed.
  virtual int geometry() const = 0;
  virtual void step() = 0;  // one frame
  virtual Snapshot snapshot() const = 0;
  virtual std::vector<EffectState> effects() const = 0;
  virtual std::vector<Knob> knobs() const = 0;
  virtual Answer reset() = 0;  // the scene as it was read, with the values that were set
  // A scene key, as --set; "none" removes it.
  virtual Answer set(const std::string& key, const std::string& value) = 0;
  virtual Answer throw_ball(const Vec3& from, const Vec3& velocity) = 0;  // m, m/s
  // Throws what throw_ball() would, and changes nothing.
  virtual void check_throw(const Vec3& from, const Vec3& velocity) const = 0;
  virtual Answer grab(int body, const Vec3& point) = 0;  // m, world: a point of the body
  virtual Answer drag(const Vec3& to) = 0;               // m, world: where the grabbed point is pulled to
  virtual Answer drop() = 0;
  // The scene as it stands, as YAML that runs. The simulation goes on from what the text says, digit by digit: a run of the
  // text has the same poses.
  virtual Answer save() = 0;
  // A second simulation in the same state, with nothing held. Both forget what a step remembers, as save() does: so they go on
  // alike, to the last digit, as long as the same is done to both.
  virtual std::unique_ptr<Simulation> copy() = 0;
  // What the next frame will do, step by step, as JSON (STREAM.md, "Algorithm"): worked out on a copy, nothing moves. Throws
  // InputError if the chapter has no such account; may throw NumericalFailure, as the frame would.
  virtual std::string algorithm() const { throw InputError("this scene has no account of its algorithm"); }
};

}  // namespace fc::live

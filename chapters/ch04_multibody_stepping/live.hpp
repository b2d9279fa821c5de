// A scene that runs while a page touches it (common/live/STREAM.md): what chapters 4 and later share, as run.hpp is for a scene
// that runs from its first frame to its last.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ch04_multibody_stepping/world.hpp"
#include "common/live/simulation.hpp"
#include "common/program.hpp"

namespace fc::world {

using NamedNumbers = std::vector<std::pair<std::string, double>>;

// A line that a run of the scene would print, and when.
struct LiveWarning {
  double time = 0;   // s, in the frame
  std::string text;  // a line
};

// What a frame did, for the page.
struct LiveFrame {
  StepReport report;
  NamedNumbers
      account;  // J, by which the total energy changed: the chapter's own entries, besides the report's
  NamedNumbers stages;  // ms; the rest of the frame has no name
  NamedNumbers effects =
      {};  // ms that an effect cost: each time counts for one; absent where a time is not measured apart
  std::vector<LiveWarning> warnings = {};
};

// A chapter's step, made ready for one world, which it may refer to.
struct LiveStep {
  std::function<LiveFrame(World&, const Listeners&)> frame;
  std::optional<double> envelope = {};  // m; the one in force, if there is one
  std::shared_ptr<void> state = {};     // the chapter's own; chapter 4 has none
};

// The step of the same bodies (there may be more now) before the scene changed: what it has found out may save a search.
struct LiveBefore {
  const LiveStep* step = nullptr;  // null: there is none, or contacts are found by another tolerance now
  bool same_rules = false;         // bodies were added, and nothing else has changed
};

// What differs from chapter to chapter.
struct LiveChapter {
  int number = 4;
  std::string name = {};  // the folder's name
  // The scene with what the chapter derives for it; empty: nothing.
  std::function<Scene(Scene)> complete = {};
  // May throw InputError: what the chapter refuses.
  std::function<LiveStep(const Scene&, World&, const LiveBefore&)> prepare = {};
  // The effects that are on, as for --explain.
  std::function<std::vector<Effect>(const Scene&, const World&)> explain = {};
  // Why an effect that is on cannot be switched off by its key: a few words; empty: it can. May be empty itself.
  std::function<std::string(const Scene&, const std::string& effect)> keeps = {};
  // The account of one frame, step by step, as JSON (common/live/STREAM.md): of a world that is a copy of the live one at the
  // frame's start, after the hand has pulled, and may be stepped. frame: how many frames came before; t0: s, its start. May
  // throw InputError. Empty: there is none.
  std::function<std::string(const Scene&, World& copy, std::int64_t frame, double t0)> algorithm = {};
};

// Chapter 4 itself.
LiveChapter live_chapter();
// Its step: also that of later chapters, for a scene without an envelope.
LiveStep live_step(const Scene& scene);
double ms(std::int64_t ns);
// The account of impacts that pushed along their normals: J, what each took from the bodies' kinetic energy, the work of kinematic
// bodies aside. The impulse times the mean of the velocities before and after, which is exact while nothing moves.
double impact_energy(const ImpactRecord& record);

// Reads the scene, and begins it. Throws InputError as a run of it would.
std::unique_ptr<live::Simulation> make_live(const SceneSource& source, const LiveChapter& chapter);

}  // namespace fc::world

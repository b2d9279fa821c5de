// A scene from its first frame to its last, with its files and its summary: what chapters 4 and later share.
#pragma once

#include <functional>

#include "ch04_multibody_stepping/record.hpp"
#include "ch04_multibody_stepping/world.hpp"
#include "common/algorithm.hpp"
#include "common/program.hpp"

namespace fc::world {

// One frame; each chapter has its own step.
using StepFunction = std::function<StepReport(World&, double dt, const Listeners&)>;

// What a chapter does to a world before its first frame. May throw InputError.
using Prepare = std::function<void(World&)>;

// The account of one frame, for --algorithm: as show_frame() (show_frame.hpp).
using FrameAccount = std::function<algorithm::Document(const Scene&, World&, std::int64_t before, double t0)>;

// Builds the world, prepares it (if there is anything to prepare), steps through all frames, writes contract 1.5's
// files into the run's folder, and fills the summary. `kinds`: contacts may last, so contacts.csv gets the column
// `kind`. `more`: the columns that the chapter adds. `account`: none if empty. Returns the exit code; throws as build_world() and the step do
// (what was written so far stays).
int run_scene(const Scene& scene, const RunContext& context, Summary& summary, const StepFunction& step_frame,
              bool kinds = false, const Prepare& prepare = {}, const MoreColumns& more = {},
              const FrameAccount& account = {});

}  // namespace fc::world

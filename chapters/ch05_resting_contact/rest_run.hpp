// A scene with an envelope from its first frame to its last: what the programs of this chapter and of later ones share.
#pragma once

#include "ch04_multibody_stepping/run.hpp"
#include "ch05_resting_contact/resting.hpp"

namespace fc::resting {

// What a later chapter changes.
struct RunOptions {
  // Its contact law for a world; empty: this chapter's.
  std::function<std::unique_ptr<ContactLaw>(world::World&)> law = {};
  // The columns that it adds to the tables; `last` is the report of the last frame.
  std::function<world::MoreColumns(const RestReport& last)> columns = {};
  // Its account of a frame; empty: this chapter's.
  world::FrameAccount account = {};
};

// The effects for --explain: chapter 4's, and those of the envelope.
std::vector<Effect> explain(const Scene& scene);
std::vector<Effect> explain(const Scene& scene, const world::World& world);
// The remark that nothing stops this kinematic body; printed with its time. frame_start: s.
std::string clash_text(const Scene& scene, const Clash& clash);
void report_clash(const Scene& scene, const Clash& clash, double frame_start);
// As world::run_scene(). The scene has an envelope.
int run_scene(const Scene& scene, const RunContext& context, Summary& summary,
              const RunOptions& options = {});
// Throws what these would throw at their start.
void check(const Scene& scene);

}  // namespace fc::resting

// Chapter 5: resting and sliding contact, by plans for the bodies that are nearer than the envelope; all else is chapter 4's.
#include "ch04_multibody_stepping/show_frame.hpp"
#include "ch05_resting_contact/clear/clear_run.hpp"
#include "ch05_resting_contact/live_rest.hpp"
#include "ch05_resting_contact/rest_run.hpp"
#include "common/live/serve.hpp"

namespace {

using namespace fc;

resting::clear::Pieces pieces;

std::vector<Effect> explain(const Scene& scene) {
  return scene.envelope ? resting::explain(scene) : world::explain(scene);
}

int run(const Scene& scene, const RunContext& context, Summary& summary) {
  if (context.clear) return resting::run_clear_scene(scene, context, summary, pieces);
  if (scene.envelope) return resting::run_scene(scene, context, summary);
  return world::run_scene(scene, context, summary, world::step, true, {}, {},
                          world::show_frame);  // chapter 4's motion, to the byte
}

void check(const Scene& scene) {
  if (scene.envelope)
    resting::check(scene);
  else
    world::build_world(scene);
}

}  // namespace

int main(int argc, char** argv) {
  Chapter chapter;
  chapter.number = 5;
  chapter.name = "ch05_resting_contact";
  chapter.purpose =
      "Moves rigid bodies that collide, rest, slide and stack, without friction. With the key `envelope`, "
      "bodies nearer than that are in contact and follow plans: proved paths that keep every gap open, with impulses that act "
      "during the whole plan. Without it, everything is as in chapter 4. Bodies that meet too often in one frame to go "
      "from one event to the next form a pile: its contacts are solved to a residual that is reported, two plans a frame, and "
      "where paths cannot be proved they are shortened, which is reported as `lost_impulse`.";
  chapter.example = "build/bin/ch05_resting_contact chapters/ch05_resting_contact/scenes/stack.yaml";
  chapter.explain = explain;
  chapter.run = run;
  chapter.check = check;
  chapter.live = [](const SceneSource& source, int port, bool quiet) {
    return live::serve(*world::make_live(source, resting::live_chapter()), port, quiet);
  };
  chapter.pieces = slots(pieces);
  return run_program(argc, argv, chapter);
}

// Chapter 4: bodies stepped from contact to contact inside frames of fixed length.
#include "ch04_multibody_stepping/live.hpp"
#include "ch04_multibody_stepping/on_pieces.hpp"
#include "ch04_multibody_stepping/run.hpp"
#include "ch04_multibody_stepping/show_frame.hpp"
#include "common/live/serve.hpp"
#include "common/program.hpp"

namespace {

using namespace fc;

int run(const Scene& scene, const RunContext& context, const world::clear::Pieces& pieces, Summary& summary) {
  const auto prepare = [&](world::World& world) {
    if (context.clear) world::put_on_pieces(world, scene, pieces);
  };
  return world::run_scene(scene, context, summary, world::step, false, prepare, {}, world::show_frame);
}

}  // namespace

int main(int argc, char** argv) {
  world::clear::Pieces pieces;  // filled before run() if the options ask for it
  Chapter chapter;
  chapter.number = 4;
  chapter.name = "ch04_multibody_stepping";
  chapter.purpose =
      "Moves rigid bodies from contact to contact inside frames of fixed length: no collision is missed, "
      "all contacts of an instant are solved together. Bodies that come to rest are frozen until the frame's end (lost_time); "
      "resting contact comes with chapter 5, friction with chapter 6.";
  chapter.example =
      "build/bin/ch04_multibody_stepping chapters/ch04_multibody_stepping/scenes/two_bunnies.yaml --poses";
  chapter.explain = world::explain;
  chapter.run = [&pieces](const Scene& scene, const RunContext& context, Summary& summary) {
    return run(scene, context, pieces, summary);
  };
  chapter.pieces = world::clear::slots(pieces);
  chapter.check = [](const Scene& scene) { world::build_world(scene); };
  chapter.live = [](const SceneSource& source, int port, bool quiet) {
    return live::serve(*world::make_live(source, world::live_chapter()), port, quiet);
  };
  return run_program(argc, argv, chapter);
}

// Chapter 4: bodies stepped from contact to contact inside frames of fixed length.
#include <fmt/format.h>

#include <chrono>

#include "ch04_multibody_stepping/record.hpp"
#include "common/program.hpp"

namespace {

using namespace fc;

int run(const Scene& scene, const RunContext& context, Summary& summary) {
  const auto start = std::chrono::steady_clock::now();
  world::World world = world::build_world(scene);
  const std::int64_t built_ns = (std::chrono::steady_clock::now() - start) / std::chrono::nanoseconds(1);
  summary.add("bodies", static_cast<std::int64_t>(world.bodies.size()));
  for (std::size_t i = 0; i < world.shapes.size(); ++i) {
    const Shape& shape = world.shapes[i];
    if (shape.kind == Shape::Kind::mesh) summary.add("shape " + shape.name, shape.report.text());
    summary.add("shape " + shape.name + ", mass from", shape.mass_source);
  }
  summary.add_time("time to build shapes and hierarchies", built_ns);

  const StepSpec& step = *scene.step;
  world::Recorder recorder(scene, world, context);
  recorder.start(world);
  Progress progress("frames", step.frames, context.quiet);
  try {
    for (int frame = 0; frame < step.frames; ++frame) {
      const world::StepReport report =
          world::step(world, step.dt,
                      {[&](const world::ImpactRecord& impact) { recorder.impact(impact); },
                       [&](const world::World& now, double time) { recorder.instant(now, time); },
                       [&](const world::Sighting& sighting) { recorder.sighting(sighting); }});
      recorder.frame(world, frame + 1, (frame + 1) * step.dt, report);
      progress.update(frame + 1);
    }
  } catch (...) {  // what was simulated so far stays, and can be watched
    recorder.close();
    throw;
  }
  summary.add_note("motion", recorder.close());
  if (recorder.first_impact()) summary.add("first impact at", *recorder.first_impact(), "s");
  world::summarize(scene, world, recorder.reports(), summary);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Chapter chapter;
  chapter.number = 4;
  chapter.name = "ch04_multibody_stepping";
  chapter.purpose =
      "Moves rigid bodies from contact to contact inside frames of fixed length: no collision is missed, all "
      "contacts of "
      "an instant are solved together. Bodies that "
      "come to rest are held (lost_time); resting contact comes with chapter 5, friction with chapter 6.";
  chapter.example =
      "build/bin/ch04_multibody_stepping chapters/ch04_multibody_stepping/scenes/two_bunnies.yaml --poses";
  chapter.explain = world::explain;
  chapter.run = run;
  return run_program(argc, argv, chapter);
}
